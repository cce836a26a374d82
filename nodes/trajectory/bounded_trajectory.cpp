// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/bounded_trajectory.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"

namespace face::trajectory {
namespace {

// A positive definite matrix of half-bandwidth b, lower part by rows: entry (i, i - j) at [i * (b + 1) + b - j].
class BandMatrix {
 public:
  BandMatrix(std::size_t size, std::size_t band) : size_(size), band_(band), values_(size * (band + 1), 0.0) {}
  double* row(std::size_t i) { return &values_[i * (band_ + 1)]; }  // row(i)[band - j] is entry (i, i - j)
  void clear() { std::fill(values_.begin(), values_.end(), 0.0); }

  // Replaces the matrix by its Cholesky factor. False where it is not positive definite.
  bool factor() {
    for (std::size_t i = 0; i < size_; ++i) {
      double* a = row(i);
      const std::size_t reach = std::min(i, band_);
      for (std::size_t j = i - reach; j <= i; ++j) {
        const double* b = row(j);
        // Columns that both rows have: from the first of the later row on.
        const std::size_t first = std::max(i - reach, j - std::min(j, band_));
        double sum = a[band_ + j - i];
        for (std::size_t k = first; k < j; ++k) sum -= a[band_ + k - i] * b[band_ + k - j];
        if (j < i) {
          a[band_ + j - i] = sum / b[band_];
        } else {
          if (!(sum > 0)) return false;
          a[band_] = std::sqrt(sum);
        }
      }
    }
    return true;
  }

  void solve(std::vector<double>& x) {
    for (std::size_t i = 0; i < size_; ++i) {
      const double* a = row(i);
      for (std::size_t j = i - std::min(i, band_); j < i; ++j) x[i] -= a[band_ + j - i] * x[j];
      x[i] /= a[band_];
    }
    for (std::size_t i = size_; i-- > 0;) {
      const double* a = row(i);
      x[i] /= a[band_];
      for (std::size_t j = i - std::min(i, band_); j < i; ++j) x[j] -= a[band_ + j - i] * x[i];
    }
  }

 private:
  std::size_t size_, band_;
  std::vector<double> values_;
};

// One side of a bound as sign * (row . x) <= limit; the box is a row with a single 1 (row = null).
struct Side {
  std::size_t first = 0;  // index of the value (box) or of the frame's first value (row)
  const double* row = nullptr;
  double sign = 1;
  double limit = 0;
};

class InteriorPoint {
 public:
  InteriorPoint(const TrajectoryTargets& targets, double smoothness, const std::vector<FrameBound>& bounds,
                const TrajectoryEnds& ends)
      : dims_(targets.dims), count_(targets.frames * targets.dims), smoothness_(smoothness), matrix_(count_, dims_) {
    diagonal_.resize(count_);
    pull_.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const bool has_before = i >= dims_ || !ends.before.empty(), has_after = i + dims_ < count_ || !ends.after.empty();
      diagonal_[i] = targets.precision[i] + (has_before ? smoothness : 0) + (has_after ? smoothness : 0);
      pull_[i] = targets.precision[i] * targets.target[i];
      if (i < dims_ && !ends.before.empty()) pull_[i] += smoothness * ends.before[i];
      if (i + dims_ >= count_ && !ends.after.empty()) pull_[i] += smoothness * ends.after[i + dims_ - count_];
    }
    for (std::size_t i = 0; i < count_; ++i) {
      sides_.push_back({i, nullptr, -1, 0});
      sides_.push_back({i, nullptr, 1, 1});
    }
    for (const FrameBound& bound : bounds) {
      if (std::isfinite(bound.low)) sides_.push_back({bound.frame * dims_, bound.row.data(), -1, -bound.low});
      if (std::isfinite(bound.high)) sides_.push_back({bound.frame * dims_, bound.row.data(), 1, bound.high});
    }
  }

  BoundedTrajectory solve() {
    constexpr int max_iterations = 60;
    // Values are weights in [0, 1] and bounds are in mm: 1e-9 is far below what the result is rounded to.
    constexpr double tolerance = 1e-13;
    BoundedTrajectory result;
    x_.assign(count_, 0.5);
    slack_.resize(sides_.size());
    dual_.assign(sides_.size(), 1.0);
    for (std::size_t i = 0; i < sides_.size(); ++i) slack_[i] = std::max(0.1, sides_[i].limit - side_value(sides_[i], x_));
    std::vector<double> step, affine_products(sides_.size(), 0.0), targets(sides_.size());
    for (result.iterations = 0; result.iterations < max_iterations; ++result.iterations) {
      residuals();
      const double gap = complementarity();
      if (gap < tolerance && largest(dual_residual_) < 1e-9 && largest(primal_residual_) < 1e-10) {
        result.converged = true;
        break;
      }
      if (!factor()) break;
      // Predictor: straight at the solution. Corrector: centred, and with the predictor's second order term.
      for (std::size_t i = 0; i < sides_.size(); ++i) targets[i] = dual_[i] * slack_[i];
      direction(targets, step);
      const double reach = std::min(longest(slack_, slack_step_), longest(dual_, dual_step_));
      double after = 0;
      for (std::size_t i = 0; i < sides_.size(); ++i) {
        after += (slack_[i] + reach * slack_step_[i]) * (dual_[i] + reach * dual_step_[i]);
        affine_products[i] = slack_step_[i] * dual_step_[i];
      }
      after /= static_cast<double>(sides_.size());
      const double centring = std::pow(after / gap, 3) * gap;
      for (std::size_t i = 0; i < sides_.size(); ++i)
        targets[i] = dual_[i] * slack_[i] + affine_products[i] - centring;
      direction(targets, step);
      const double length = std::min(1.0, 0.995 * std::min(longest(slack_, slack_step_), longest(dual_, dual_step_)));
      for (std::size_t i = 0; i < count_; ++i) x_[i] += length * step[i];
      for (std::size_t i = 0; i < sides_.size(); ++i) {
        slack_[i] += length * slack_step_[i];
        dual_[i] += length * dual_step_[i];
      }
    }
    for (double& value : x_) value = std::clamp(value, 0.0, 1.0);
    result.values = std::move(x_);
    return result;
  }

 private:
  double side_value(const Side& side, const std::vector<double>& x) const {
    if (side.row == nullptr) return side.sign * x[side.first];
    double sum = 0;
    for (std::size_t k = 0; k < dims_; ++k) sum += side.row[k] * x[side.first + k];
    return side.sign * sum;
  }
  void add_side(const Side& side, double factor, std::vector<double>& to) const {
    if (side.row == nullptr) {
      to[side.first] += side.sign * factor;
    } else {
      for (std::size_t k = 0; k < dims_; ++k) to[side.first + k] += side.sign * factor * side.row[k];
    }
  }
  static double largest(const std::vector<double>& values) {
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
  }
  // How far a positive vector may go along a step before it reaches 0, at most 1.
  static double longest(const std::vector<double>& from, const std::vector<double>& step) {
    double length = 1;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (step[i] < 0) length = std::min(length, -from[i] / step[i]);
    return length;
  }
  double complementarity() const {
    double sum = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) sum += slack_[i] * dual_[i];
    return sum / static_cast<double>(sides_.size());
  }

  void residuals() {
    dual_residual_.assign(count_, 0.0);
    for (std::size_t i = 0; i < count_; ++i) {
      double value = diagonal_[i] * x_[i] - pull_[i];
      if (i >= dims_) value -= smoothness_ * x_[i - dims_];
      if (i + dims_ < count_) value -= smoothness_ * x_[i + dims_];
      dual_residual_[i] = value;
    }
    primal_residual_.resize(sides_.size());
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      add_side(sides_[i], dual_[i], dual_residual_);
      primal_residual_[i] = side_value(sides_[i], x_) + slack_[i] - sides_[i].limit;
    }
  }

  bool factor() {
    matrix_.clear();
    for (std::size_t i = 0; i < count_; ++i) {
      matrix_.row(i)[dims_] = diagonal_[i];
      if (i >= dims_) matrix_.row(i)[0] = -smoothness_;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const double weight = dual_[i] / slack_[i];
      const Side& side = sides_[i];
      if (side.row == nullptr) {
        matrix_.row(side.first)[dims_] += weight;
        continue;
      }
      for (std::size_t a = 0; a < dims_; ++a)
        for (std::size_t b = 0; b <= a; ++b)
          matrix_.row(side.first + a)[dims_ + b - a] += weight * side.row[a] * side.row[b];
    }
    return matrix_.factor();
  }

  // Newton direction for complementarity products reduced by `products`.
  void direction(const std::vector<double>& products, std::vector<double>& step) {
    step.assign(count_, 0.0);
    for (std::size_t i = 0; i < count_; ++i) step[i] = -dual_residual_[i];
    for (std::size_t i = 0; i < sides_.size(); ++i)
      add_side(sides_[i], -(dual_[i] * primal_residual_[i] - products[i]) / slack_[i], step);
    matrix_.solve(step);
    slack_step_.resize(sides_.size());
    dual_step_.resize(sides_.size());
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      slack_step_[i] = -primal_residual_[i] - side_value(sides_[i], step);
      dual_step_[i] = -(products[i] + dual_[i] * slack_step_[i]) / slack_[i];
    }
  }

  std::size_t dims_, count_;
  double smoothness_;
  BandMatrix matrix_;
  std::vector<double> diagonal_, pull_;
  std::vector<Side> sides_;
  std::vector<double> x_, slack_, dual_, slack_step_, dual_step_, dual_residual_, primal_residual_;
};

}  // namespace

BoundedTrajectory solve_bounded_trajectory(const TrajectoryTargets& targets, double smoothness,
                                           const std::vector<FrameBound>& bounds, const TrajectoryEnds& ends) {
  const std::size_t count = targets.frames * targets.dims;
  check(targets.precision.size() == count && targets.target.size() == count, "precision has ", targets.precision.size(),
        " values and target ", targets.target.size(), ", expected ", targets.frames, " x ", targets.dims, " = ", count);
  for (const FrameBound& bound : bounds)
    check(bound.frame < targets.frames && bound.row.size() == targets.dims, "a bound on frame ", bound.frame, " has ",
          bound.row.size(), " coefficients, expected a frame below ", targets.frames, " and ", targets.dims);
  if (count == 0) return {{}, true, 0};
  return InteriorPoint(targets, smoothness, bounds, ends).solve();
}

}  // namespace face::trajectory
