// SPDX-License-Identifier: Apache-2.0
// Smooth motions of a head's surface, before anything is known of how heads differ.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "nodes/types/vec.h"

namespace face::model {

struct MotionBasisOptions {
  double motion_mm = 4;         // standard deviation of a place along each axis, moved as its mirror image is
  double asymmetry = 0.4;       // how large motion is that is not mirrored, of that
  std::size_t functions = 160;  // at most, of a kind: even and odd ones
};

// Displacements u(p) of a Gaussian process about a surface: covariances of four scales, 15 to 120 mm, in equal shares,
// mostly mirror symmetric about the plane x = mirror_x_mm (Luethi, Gerig, Jud, Vetter: Gaussian Process Morphable
// Models, PAMI 2018, sections 3.1 and 4.2). Differs from the paper: the kernel's rank is lowered by its pivoted
// Cholesky factor (Harbrecht, Peters, Schneider: On the low-rank approximation by the pivoted Cholesky decomposition,
// 2012) at `places` instead of Nystroem's eigenvectors, which takes a tenth of the time. u = sum of coefficient k times
// function k; last come shift and turn of the whole head, which the process lacks.
class MotionBasis {
 public:
  MotionBasis(const std::vector<Vec3f>& places_mm, double mirror_x_mm, const MotionBasisOptions& options = {});
  ~MotionBasis();

  std::size_t size() const { return precision_.size(); }
  // 1 / variance of every coefficient.
  const std::vector<double>& precision() const { return precision_; }

  // What every coefficient moves place i by along a direction.
  void row(std::size_t i, const std::array<double, 3>& direction, std::span<double> out) const;
  // Displacements of any points.
  std::vector<std::array<double, 3>> displacements(const std::vector<Vec3f>& points_mm,
                                                   const std::vector<double>& coefficients) const;
  // Displacements of the places.
  std::vector<std::array<double, 3>> displacements(const std::vector<double>& coefficients) const;

 private:
  class Process;
  std::unique_ptr<const Process> process_;
  std::vector<double> precision_;
};

}  // namespace face::model
