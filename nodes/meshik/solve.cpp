// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/solve.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/meshik/blend_jacobian.h"
#include "nodes/meshik/constraint_solver.h"
#include "nodes/meshik/factor_space.h"
#include "nodes/meshik/gradient_sums.h"
#include "nodes/meshik/mesh_triangles.h"

namespace face::meshik {
namespace {

using FloatMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

struct MeshIkSolver::State {
  State(const MeshSpace& s, const VertexTargets& targets, double give)
      : space(s), give_mm2(give), constraints(s, targets, give), still_sums(4 * (free_count(s) + 1), 0.0) {
    for (std::size_t tile = moving_tile_count(space); tile < tile_count(space); ++tile)
      add_gradients(space, tile, frame_tile(space, tile), still_sums.data());
  }

  const MeshSpace& space;
  const double give_mm2;
  ConstraintSolver constraints;
  std::vector<double> still_sums;  // of the triangles that no example changes

  // Megabytes that are used again from step to step.
  struct Room {
    std::vector<BlendTile> tiles;  // the moving ones, at the weights that were evaluated last
    std::vector<double> sums;
  };

  void check_same(const VertexTargets& targets) const {
    bool same = targets.targets.size() == constraints.vertices().size();
    std::size_t z = 0;
    for (std::size_t i = 0; same && i < targets.targets.size(); ++i) {
      const VertexTarget& target = targets.targets[i];
      const std::vector<std::size_t>& with_z = constraints.axis(2).targets;
      same = target.vertex == constraints.vertices()[i] && target.has_z == (z < with_z.size() && with_z[z] == i);
      z += target.has_z;
      for (const double value : {target.x_mm, target.y_mm, target.has_z ? target.z_mm : 0})
        check(std::isfinite(value), "target ", i, " is at ", value, " mm, expected finite numbers");
    }
    check(same, "the targets are other vertices than those that the solver was made for");
  }

  static double missed_mm2(const VertexTargets& targets, const std::vector<double>& vertices) {
    double sum = 0;
    for (const VertexTarget& target : targets.targets) {
      const double* at = &vertices[3 * target.vertex];
      sum += std::pow(at[0] - target.x_mm, 2) + std::pow(at[1] - target.y_mm, 2);
      if (target.has_z) sum += std::pow(at[2] - target.z_mm, 2);
    }
    return sum;
  }

  double evaluate(const VertexTargets& targets, const std::vector<double>& weights, std::vector<double>& vertices,
                  std::vector<double>* gradient, Room& room) const {
    std::vector<BlendTile>& tiles = room.tiles;
    room.sums = still_sums;
    tiles.resize(moving_tile_count(space));
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      blend_tile(space, tile, weights.data(), tiles[tile]);
      add_gradients(space, tile, tiles[tile].blended, room.sums.data());
    }
    vertices = constraints.solve(room.sums, targets, weights);
    if (gradient) gradient->assign(weights.size(), 0.0);
    double energy = give_mm2 > 0 ? missed_mm2(targets, vertices) / give_mm2 : 0;
    TileVectors residual;
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      energy += residual_of(space, tile, tiles[tile].blended, vertices, residual);
      // dE/da = -2 J'r: the vertices are at their best, so that their own change does not count.
      if (gradient) add_blend_gradient(space, tile, tiles[tile], residual, gradient->data());
    }
    for (std::size_t tile = tiles.size(); tile < tile_count(space); ++tile)
      energy += residual_of(space, tile, frame_tile(space, tile), vertices, residual);
    if (gradient)
      for (double& value : *gradient) value *= -2;
    return energy;
  }

  // J of a block of moving tiles, for each axis: two rows a triangle, `width` columns.
  struct Derivatives {
    static constexpr std::size_t tiles = 16;  // whose rows stay in the cache
    std::array<std::vector<float>, 3> rows;

    // blends: of all moving tiles. Returns how many triangles these are.
    std::size_t fill(const MeshSpace& space, std::size_t first, const std::vector<BlendTile>& blends,
                     std::size_t width) {
      const std::size_t end = std::min(first + tiles, moving_tile_count(space));
      for (std::vector<float>& part : rows) part.assign((end - first) * tile_lanes * 2 * width, 0.0f);
      TileVectors derivative;
      for (std::size_t tile = first; tile < end; ++tile) {
        for (std::size_t k = 0; k < space.example_count; ++k) {
          blend_derivative(space, tile, k, blends[tile], derivative);
          for (std::size_t d = 0; d < 3; ++d) {
            float* const to = &rows[d][(tile - first) * tile_lanes * 2 * width + k];
            for (std::size_t l = 0; l < tile_lanes; ++l)
              for (std::size_t q = 0; q < 2; ++q) to[(2 * l + q) * width] = static_cast<float>(derivative[q][d][l]);
          }
        }
      }
      return std::min(end * tile_lanes, space.triangles.size() / 3) - first * tile_lanes;
    }
  };

  // Half the second derivative of the energy, without the curvature of M (Gauss-Newton), in single precision: it only
  // steers. blends: of all moving tiles, at the weights that it is wanted for.
  Eigen::MatrixXd hessian(const std::vector<BlendTile>& blends) const {
    const std::size_t examples = space.example_count, width = (examples + 7) / 8 * 8, count = free_count(space);
    FloatMatrix hessian = FloatMatrix::Zero(index(width), index(width));
    // B = G'J of each axis.
    std::array<std::vector<float>, 3> sums;
    for (std::vector<float>& part : sums) part.assign((count + 1) * width, 0.0f);
    Derivatives block;
    for (std::size_t first = 0; first < moving_tile_count(space); first += Derivatives::tiles) {
      const std::size_t triangles = block.fill(space, first, blends, width);
      for (std::size_t d = 0; d < 3; ++d) {
        const Eigen::Map<const FloatMatrix> j(block.rows[d].data(), index(2 * triangles), index(width));
        hessian.selfadjointView<Eigen::Lower>().rankUpdate(j.transpose());
        for (std::size_t i = 0; i < triangles; ++i) {
          const std::size_t t = first * tile_lanes + i;
          const HatGradients g = hat_gradients(space, t);
          const float* const row = &block.rows[d][i * 2 * width];
          for (std::size_t c = 0; c < 3; ++c) {
            float* const sum = &sums[d][std::min<std::size_t>(space.order[space.triangles[3 * t + c]], count) * width];
            const auto a = static_cast<float>(g.along[c][0]), b = static_cast<float>(g.along[c][1]);
            for (std::size_t k = 0; k < width; ++k) sum[k] += a * row[k] + b * row[width + k];
          }
        }
      }
    }
    for (std::size_t d = 0; d < 3; ++d) {
      // Z = L^-1 B.
      solve_lower_wide(space, sums[d].data(), width);
      const Eigen::Map<const FloatMatrix> z(sums[d].data(), index(count), index(width));
      hessian.selfadjointView<Eigen::Lower>().rankUpdate(z.transpose(), -1.0f);
      // What the constraints take from the vertices' freedom.
      const AxisConstraints& axis = constraints.axis(d);
      const std::size_t n = axis.targets.size(), size = n + axis.parts.size(), columns = constraints.vertices().size();
      if (n == 0) continue;
      const std::vector<std::uint32_t>& reached = constraints.reached();
      FloatMatrix rows(index(reached.size()), index(width));
      for (std::size_t r = 0; r < reached.size(); ++r) rows.row(index(r)) = z.row(index(reached[r]));
      const Eigen::Map<const RowMatrix> lower(constraints.lower().data(), index(reached.size()), index(columns));
      const RowMatrix moved = lower.transpose() * rows.cast<double>();  // C A^-1 B
      RowMatrix chosen(index(n), index(width));
      for (std::size_t i = 0; i < n; ++i) chosen.row(index(i)) = moved.row(index(axis.targets[i]));
      const Eigen::Map<const RowMatrix> inverse(axis.inverse.data(), index(size), index(size));
      hessian += (chosen.transpose() * inverse.topLeftCorner(index(n), index(n)) * chosen).cast<float>();
    }
    const Eigen::MatrixXf full = hessian.selfadjointView<Eigen::Lower>();
    return full.topLeftCorner(index(examples), index(examples)).cast<double>();
  }
};

MeshIkSolver::MeshIkSolver(const MeshSpace& space, const VertexTargets& targets, double give_mm2)
    : state_(std::make_unique<const State>(space, targets, give_mm2)) {}
MeshIkSolver::~MeshIkSolver() = default;

double MeshIkSolver::energy(const VertexTargets& targets, const std::vector<double>& weights,
                            std::vector<double>* gradient) const {
  state_->check_same(targets);
  std::vector<double> vertices;
  State::Room room;
  return state_->evaluate(targets, weights, vertices, gradient, room);
}

VertexSolution MeshIkSolver::solve_vertices(const VertexTargets& targets, const std::vector<double>& start,
                                            const SolveOptions& options) const {
  const MeshSpace& space = state_->space;
  check(start.size() == space.example_count, "start has ", start.size(), " weights, expected ", space.example_count);
  state_->check_same(targets);
  const std::size_t count = start.size();
  const double restraint = options.restraint * static_cast<double>(space.triangles.size() / 3);
  VertexSolution best;
  best.weights = start;
  std::vector<double> gradient;
  State::Room room;
  best.energy = state_->evaluate(targets, best.weights, best.vertices_mm, &gradient, room);
  best.converged = count == 0;
  const auto with_restraint = [&](double energy, const std::vector<double>& weights) {
    for (const double weight : weights) energy += restraint * weight * weight;
    return energy;
  };
  // Half the gradient and half the Hessian, with the restraint. The Hessian is Gauss and Newton's at the start; then
  // every step teaches it the curvature that it met.
  const auto slope_of = [&](const std::vector<double>& at, const std::vector<double>& weights) {
    Eigen::VectorXd slope(index(count));
    for (std::size_t k = 0; k < count; ++k) slope[index(k)] = at[k] / 2 + restraint * weights[k];
    return slope;
  };
  Eigen::MatrixXd hessian;
  double damping = 0;
  bool fresh = false, stepped_back = false;
  while (!best.converged && best.iterations < options.max_iterations) {
    ++best.iterations;
    if (hessian.size() == 0) {
      // After a step that was not taken the blends are those of where it led.
      if (stepped_back) state_->evaluate(targets, best.weights, best.vertices_mm, nullptr, room);
      hessian = state_->hessian(room.tiles);
      // Single precision leaves 1e-6 of the diagonal uncertain.
      hessian.diagonal().array() += restraint + 1e-6 * hessian.trace() / static_cast<double>(count);
      fresh = true;
    }
    const Eigen::VectorXd slope = slope_of(gradient, best.weights);
    Eigen::MatrixXd damped = hessian;
    damped.diagonal().array() += damping * hessian.trace() / static_cast<double>(count);
    const Eigen::VectorXd step = -damped.ldlt().solve(slope);
    const double length = step.cwiseAbs().maxCoeff();
    if (!std::isfinite(length)) break;
    std::vector<double> weights = best.weights, vertices, next_gradient;
    for (std::size_t k = 0; k < count; ++k) weights[k] += step[index(k)];
    const bool last = length < options.tolerance;
    const double energy = state_->evaluate(targets, weights, vertices, last ? nullptr : &next_gradient, room);
    const double before = with_restraint(best.energy, best.weights), after = with_restraint(energy, weights);
    // Rounding may raise an energy that is at its least.
    if (after > before * (1 + 1e-10) + 1e-18) {
      best.converged = last;
      stepped_back = true;
      // Another Hessian first; where this one was new, a shorter step.
      if (fresh)
        damping = damping > 0 ? damping * 10 : 1e-3;
      else
        hessian.resize(0, 0);
      continue;
    }
    stepped_back = false;
    best.weights = std::move(weights);
    best.vertices_mm = std::move(vertices);
    best.energy = energy;
    best.converged = last;
    if (last) break;
    const Eigen::VectorXd turn = slope_of(next_gradient, best.weights) - slope;
    const double curvature = turn.dot(step);
    if (curvature > 1e-12 * turn.norm() * step.norm()) {
      const Eigen::VectorXd known = hessian * step;
      hessian += turn * turn.transpose() / curvature - known * known.transpose() / known.dot(step);
      fresh = false;
    }
    gradient = std::move(next_gradient);
    damping = damping > 1e-6 ? damping / 10 : 0;
  }
  return best;
}

SolveResult solve(const MeshSpace& space, const VertexTargets& targets, const Weights* start,
                  const SolveOptions& options) {
  check_space(space);
  if (start && start->values.empty() && targets.targets.empty()) return {};
  std::vector<double> weights(static_cast<std::size_t>(space.example_count), 0.0);
  if (start) {
    check(start->values.size() <= weights.size(), "start has ", start->values.size(), " weights, expected at most ",
          weights.size());
    for (std::size_t k = 0; k < start->values.size(); ++k) {
      check(std::isfinite(start->values[k]), "start holds ", start->values[k], ", expected finite numbers");
      weights[k] = static_cast<double>(start->values[k]);
    }
  }
  const VertexSolution found = MeshIkSolver(space, targets, options.give_mm2).solve_vertices(targets, weights, options);
  SolveResult result;
  for (const double weight : found.weights) result.weights.values.push_back(static_cast<float>(weight));
  result.points.points_mm = points_of(found.vertices_mm);
  const double triangles = std::max(1.0, static_cast<double>(space.triangles.size() / 3));
  result.rms_gradient = std::sqrt(found.energy / triangles);
  result.converged = found.converged;
  result.iterations = found.iterations;
  return result;
}

}  // namespace face::meshik
