// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/types/mesh_points.h"
#include "nodes/types/mesh_space.h"
#include "nodes/types/vertex_targets.h"
#include "nodes/types/weights.h"

namespace face::meshik {

struct SolveOptions {
  std::int64_t max_iterations = 40;
  double tolerance = 1e-4;  // largest step of a weight that counts as none; what is left is far smaller
  // Energy of a weight of 1, per triangle. Directions of the weights that the constraints do not tell apart stay near
  // 0.
  double restraint = 1e-8;
  // Targets that are uncertain: missing one by d mm costs d^2 / give_mm2 of energy, and where they contradict each
  // other or all examples they are not reached. 0 = exactly.
  double give_mm2 = 0;
};

struct VertexSolution {
  std::vector<double> weights;      // K
  std::vector<double> vertices_mm;  // 3 V
  double energy = 0;                // |G v - M(a)|^2 and what missed targets cost, without the restraint
  bool converged = false;
  std::int64_t iterations = 0;
};

// Solves Eq 1 of Animating Lip-Sync Speech Faces for many frames with the same constrained vertices:
//   v, a = argmin |G v - M(a)|^2  subject to the coordinates asked for being where they are wanted.
// Vertices are eliminated: for given weights they are one linear solve with the constraints as exact equations (their
// Schur complement, so that the factor of MeshSpace serves every set of constraints). What is left is a least squares
// problem in a alone. Its first step is Gauss-Newton's, with the exact derivative of the exponential map; further steps
// correct that Hessian by the curvature that they meet (Broyden, Fletcher, Goldfarb, Shanno; Nocedal and Wright,
// Numerical Optimization, 2006, eq. 6.19), and are damped where the energy would grow (Marquardt, An Algorithm for
// Least-Squares Estimation of Nonlinear Parameters, 1963). Differs from Sumner et al. 2005, who solve for v and a at
// once and put the fourth vertices in; and targets may give way (give_mm2).
class MeshIkSolver {
 public:
  // targets: which coordinates are constrained; their places do not matter here. Keeps a reference to space. give_mm2:
  // as in SolveOptions, whose own does not matter here.
  MeshIkSolver(const MeshSpace& space, const VertexTargets& targets, double give_mm2 = 0);
  ~MeshIkSolver();

  // targets: the same vertices in the same order. start: K weights, a good guess saves iterations.
  VertexSolution solve_vertices(const VertexTargets& targets, const std::vector<double>& start,
                                const SolveOptions& options) const;

  // The energy and its gradient for given weights, the vertices solved for.
  double energy(const VertexTargets& targets, const std::vector<double>& weights, std::vector<double>* gradient) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

struct SolveResult {
  Weights weights;
  MeshPoints points;
  double rms_gradient = 0;  // root mean square over triangles of what the examples cannot explain of the gradients
  bool converged = false;
  std::int64_t iterations = 0;
};

// Weights and vertices of one frame whose vertices have to be at targets: x and y always, z where it is given. start:
// weights to begin with, for example of the NNLS fit or of a neighbouring frame (null: 0). Where nothing is asked for,
// the result is the reference; with a start that is empty as well (a frame that was lost), weights and vertices are
// empty.
SolveResult solve(const MeshSpace& space, const VertexTargets& targets, const Weights* start,
                  const SolveOptions& options = {});

}  // namespace face::meshik
