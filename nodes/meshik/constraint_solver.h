// SPDX-License-Identifier: Apache-2.0
// The linear half of Eq 1: vertices for given gradients under constraints. Internal to MeshIkSolver; Eigen stays out.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/mesh_space.h"
#include "nodes/types/vertex_targets.h"

namespace face::meshik {

// Constraints of one axis: which of the targets, and the inverse of
//   [ C A^-1 C' + give I  E ]     A = G'G without pinned vertices, E = part of every constrained vertex
//   [ E'                  0 ]
// whose solution is the pull of every constraint and the shift of every part that has one.
struct AxisConstraints {
  std::vector<std::size_t> targets;
  std::vector<std::uint32_t> parts;  // of the mesh, those with a constraint
  std::vector<double> inverse;       // (targets + parts)^2, row by row
};

class ConstraintSolver {
 public:
  // give_mm2: the energy |C v - c|^2 / give takes the place of C v = c; 0 = exactly there.
  ConstraintSolver(const MeshSpace& space, const VertexTargets& targets, double give_mm2 = 0);

  const std::vector<std::uint32_t>& vertices() const { return vertices_; }
  const AxisConstraints& axis(std::size_t d) const { return d == 2 ? z_ : xy_; }
  // Rows of L^-1 P c that are not 0 for every target, ascending: few, since a column of L^-1 is filled along one path
  // of the elimination tree alone (Gilbert and Peierls, Sparse Partial Pivoting in Time Proportional to Arithmetic
  // Operations, 1988).
  const std::vector<std::uint32_t>& reached() const { return reached_; }
  // These rows: reached x targets.
  const std::vector<double>& lower() const { return lower_; }

  // From the sums of gradients (free_count + 1 rows of 4) to vertices; `sums` is overwritten.
  std::vector<double> solve(std::vector<double>& sums, const VertexTargets& targets,
                            const std::vector<double>& weights) const;

 private:
  void reach();
  void make_axis(const std::vector<std::size_t>& chosen, AxisConstraints& axis) const;

  const MeshSpace& space_;
  const double give_mm2_;
  std::vector<std::uint32_t> vertices_, reached_;
  std::vector<double> lower_, schur_;  // schur: C A^-1 C'
  AxisConstraints xy_, z_;
};

}  // namespace face::meshik
