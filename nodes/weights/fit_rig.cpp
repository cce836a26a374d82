// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/fit_rig.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/types/arkit.h"

namespace face::weights {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

double dot(const Vec3f& a, const Vec3f& b) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += static_cast<double>(a[d]) * static_cast<double>(b[d]);
  return sum;
}

// The offsets of every vertex from rest.
std::vector<Vec3f> offsets(const Rig& rig, const MeshPoints& points) {
  std::vector<Vec3f> moved = points.points_mm;
  for (std::size_t v = 0; v < moved.size(); ++v)
    for (std::size_t d = 0; d < 3; ++d) moved[v][d] -= rig.neutral.points_mm[v][d];
  return moved;
}

// What a shape and a field of offsets have in common.
double along(const Shape& shape, const std::vector<Vec3f>& field) {
  double sum = 0;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) sum += dot(shape.offsets_mm[i], field[shape.vertices[i]]);
  return sum;
}

// Least squares over the shapes' weights within [0, 1].
class BoundedFit {
 public:
  BoundedFit(const Rig& rig, double restraint) {
    for (std::size_t s = 0; s < std::min(rig.shapes.size(), arkit_count); ++s)
      if (!rig.shapes[s].vertices.empty()) shapes_.push_back(&rig.shapes[s]), places_.push_back(s);
    check(!shapes_.empty(), "the rig has none of the 52 ARKit shapes");
    const auto count = static_cast<Index>(shapes_.size());
    products_.resize(count, count);
    std::vector<Vec3f> field;
    for (Index a = 0; a < count; ++a) {
      field.assign(rig.neutral.points_mm.size(), {0, 0, 0});
      add_shape(shape(a), 1, field);
      for (Index b = 0; b < count; ++b) products_(a, b) = along(shape(b), field);
    }
    products_.diagonal().array() += restraint * products_.trace() / static_cast<double>(count);
  }

  Weights weights(const std::vector<Vec3f>& moved) const {
    VectorXd wanted(products_.rows());
    for (Index a = 0; a < wanted.size(); ++a) wanted[a] = along(shape(a), moved);
    const VectorXd found = solve(wanted);
    Weights result{std::vector<float>(arkit_count, 0.0f)};
    for (Index a = 0; a < found.size(); ++a)
      result.values[places_[static_cast<std::size_t>(a)]] = static_cast<float>(found[a]);
    return result;
  }

 private:
  const Shape& shape(Index a) const { return *shapes_[static_cast<std::size_t>(a)]; }

  // Minimises w'Pw / 2 - wanted'w: Newton's step of the weights that are free to move, bent at the bounds, halved until
  // it gains; where no share of it does, weight by weight.
  VectorXd solve(const VectorXd& wanted) const {
    constexpr int most_steps = 200;
    constexpr double settled = 1e-12;  // of the largest slope at rest
    const double small = settled * wanted.cwiseAbs().maxCoeff();
    VectorXd weights = VectorXd::Zero(wanted.size());
    for (int step = 0; step < most_steps; ++step) {
      const VectorXd slope = products_ * weights - wanted;
      std::vector<Index> free;
      for (Index a = 0; a < slope.size(); ++a) {
        const bool held = (weights[a] <= 0 && slope[a] > 0) || (weights[a] >= 1 && slope[a] < 0);
        if (!held && std::abs(slope[a]) > small) free.push_back(a);
      }
      if (free.empty() || !(move(free, slope, weights) || move_singly(free, wanted, weights))) break;
    }
    return weights;
  }

  // One such step; false where it gains nothing.
  bool move(const std::vector<Index>& free, const VectorXd& slope, VectorXd& weights) const {
    const VectorXd ahead = -products_(free, free).ldlt().solve(slope(free));
    for (double share = 1; share > 1e-6; share /= 2) {
      VectorXd next = weights;
      for (std::size_t i = 0; i < free.size(); ++i) {
        double& weight = next[free[i]];
        weight = std::clamp(weight + share * ahead[static_cast<Index>(i)], 0.0, 1.0);
      }
      const VectorXd step = next - weights;
      if (!(slope.dot(step) + 0.5 * step.dot(products_ * step) < 0)) continue;
      weights = next;
      return true;
    }
    return false;
  }

  bool move_singly(const std::vector<Index>& free, const VectorXd& wanted, VectorXd& weights) const {
    bool moved = false;
    for (const Index a : free) {
      const double slope = products_.row(a).dot(weights) - wanted[a];
      const double next = std::clamp(weights[a] - slope / products_(a, a), 0.0, 1.0);
      moved = moved || next != weights[a];
      weights[a] = next;
    }
    return moved;
  }

  std::vector<const Shape*> shapes_;
  std::vector<std::size_t> places_;  // in the rig
  MatrixXd products_;                // of every two shapes, with the restraint
};

}  // namespace

FitRigResult fit_rig(const Rig& rig, const engine::Seq<MeshPoints>& points, engine::SeqWriter<Weights>& weights,
                     const FitRigOptions& options, engine::Progress& progress) {
  check(!points.empty(), "there are no frames");
  check(options.restraint > 0, "restraint is ", options.restraint, ", expected more than 0");
  const BoundedFit fit(rig, options.restraint);
  const std::size_t vertices = rig.neutral.points_mm.size();
  FitRigResult result;
  double squares = 0, counted = 0;
  Weights last{std::vector<float>(arkit_count, 0.0f)};
  for (std::size_t frame = 0; frame < points.size(); ++frame) {
    const auto here = points.at(frame);
    if (!here->points_mm.empty()) {
      check(here->points_mm.size() == vertices, "frame ", points.id(frame), " has ", here->points_mm.size(),
            " vertices, expected ", vertices, " as the rig");
      std::vector<Vec3f> left = offsets(rig, *here);
      last = fit.weights(left);
      for (std::size_t s = 0; s < std::min(rig.shapes.size(), arkit_count); ++s)
        if (last.values[s] > 0) add_shape(rig.shapes[s], -last.values[s], left);
      for (const Vec3f& vertex : left) {
        const double square = dot(vertex, vertex);
        squares += square;
        result.largest_mm = std::max(result.largest_mm, std::sqrt(square));
      }
      counted += static_cast<double>(vertices);
    }
    weights.push(points.id(frame), Weights(last));
    progress.report(static_cast<double>(frame) / static_cast<double>(points.size()));
  }
  if (counted > 0) result.rms_mm = std::sqrt(squares / counted);
  return result;
}

}  // namespace face::weights
