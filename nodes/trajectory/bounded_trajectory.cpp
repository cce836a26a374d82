// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/bounded_trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

constexpr double infinity = std::numeric_limits<double>::infinity();

// One side of a bound as sign * value(x) <= limit + excess, where the excess costs its price; a hard bound has none.
struct Side {
  enum class Kind { box, step, row } kind = Kind::box;
  std::size_t first = 0;  // box: index of the value. step: of the later value. row: of the frame's first value
  const double* row = nullptr;
  double sign = 1;
  double limit = 0;
  double price = infinity;
};

class InteriorPoint {
 public:
  InteriorPoint(const TrajectoryTargets& targets, double smoothness, const std::vector<FrameBound>& bounds,
                const TrajectoryEnds& ends, const StepBound& steps)
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
      sides_.push_back({Side::Kind::box, i, nullptr, -1, 0, infinity});
      sides_.push_back({Side::Kind::box, i, nullptr, 1, 1, infinity});
      if (!std::isfinite(steps.largest)) continue;
      const bool last = i + dims_ >= count_;
      for (const double sign : {-1.0, 1.0}) {
        if (i >= dims_) sides_.push_back({Side::Kind::step, i, nullptr, sign, steps.largest, steps.price});
        if (i < dims_ && !ends.before.empty())
          sides_.push_back({Side::Kind::box, i, nullptr, sign, steps.largest + sign * ends.before[i], steps.price});
        if (last && !ends.after.empty())
          sides_.push_back(
              {Side::Kind::box, i, nullptr, sign, steps.largest + sign * ends.after[i + dims_ - count_], steps.price});
      }
    }
    for (const FrameBound& bound : bounds) {
      const std::size_t first = bound.frame * dims_;
      if (std::isfinite(bound.low))
        sides_.push_back({Side::Kind::row, first, bound.row.data(), -1, -bound.low, bound.price});
      if (std::isfinite(bound.high))
        sides_.push_back({Side::Kind::row, first, bound.row.data(), 1, bound.high, bound.price});
    }
  }

  BoundedTrajectory solve() {
    constexpr int max_iterations = 80;
    // Far below what the weights are rounded to, so that rounding does not tell two runs of one problem apart.
    constexpr double tolerance = 1e-13;
    BoundedTrajectory result;
    start();
    std::vector<double> step;
    for (result.iterations = 0; result.iterations < max_iterations; ++result.iterations) {
      residuals();
      const double gap = complementarity(0);
      if (gap < tolerance && largest(dual_residual_) < 1e-9 && largest(primal_residual_) < 1e-10) {
        result.converged = true;
        break;
      }
      if (!factor()) break;
      // Predictor: straight at the solution. Corrector: centred, and with the predictor's second order term.
      const std::size_t n = sides_.size();
      for (std::size_t i = 0; i < n; ++i) {
        slack_product_[i] = dual_[i] * slack_[i];
        excess_product_[i] = is_soft(i) ? (sides_[i].price - dual_[i]) * excess_[i] : 0;
      }
      direction(step);
      const double centring = std::pow(complementarity(longest()) / gap, 3) * gap;
      for (std::size_t i = 0; i < n; ++i) {
        slack_product_[i] += slack_step_[i] * dual_step_[i] - centring;
        if (is_soft(i)) excess_product_[i] += -excess_step_[i] * dual_step_[i] - centring;
      }
      direction(step);
      const double length = std::min(1.0, 0.995 * longest());
      for (std::size_t i = 0; i < count_; ++i) x_[i] += length * step[i];
      for (std::size_t i = 0; i < n; ++i) {
        slack_[i] += length * slack_step_[i];
        dual_[i] += length * dual_step_[i];
        excess_[i] += length * excess_step_[i];
      }
    }
    for (double& value : x_) value = std::clamp(value, 0.0, 1.0);
    result.values = std::move(x_);
    return result;
  }

 private:
  bool is_soft(std::size_t i) const { return std::isfinite(sides_[i].price); }

  void start() {
    const std::size_t n = sides_.size();
    x_.assign(count_, 0.5);
    slack_.resize(n);
    dual_.resize(n);
    excess_.assign(n, 0.0);
    for (auto* values :
         {&slack_step_, &dual_step_, &excess_step_, &slack_product_, &excess_product_, &primal_residual_})
      values->assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      slack_[i] = std::max(0.1, sides_[i].limit - side_value(sides_[i], x_));
      dual_[i] = is_soft(i) ? std::min(1.0, sides_[i].price / 2) : 1.0;
      if (is_soft(i)) excess_[i] = std::min(0.1, 0.1 / (sides_[i].price - dual_[i]));
    }
  }

  double side_value(const Side& side, const std::vector<double>& x) const {
    if (side.kind == Side::Kind::box) return side.sign * x[side.first];
    if (side.kind == Side::Kind::step) return side.sign * (x[side.first] - x[side.first - dims_]);
    double sum = 0;
    for (std::size_t k = 0; k < dims_; ++k) sum += side.row[k] * x[side.first + k];
    return side.sign * sum;
  }
  void add_side(const Side& side, double factor, std::vector<double>& to) const {
    if (side.kind == Side::Kind::row) {
      for (std::size_t k = 0; k < dims_; ++k) to[side.first + k] += side.sign * factor * side.row[k];
      return;
    }
    to[side.first] += side.sign * factor;
    if (side.kind == Side::Kind::step) to[side.first - dims_] -= side.sign * factor;
  }
  static double largest(const std::vector<double>& values) {
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
  }
  // How far all that must stay positive may go along the step, at most 1.
  double longest() const {
    double length = 1;
    const auto limit = [&](double from, double along) {
      if (along < 0) length = std::min(length, -from / along);
    };
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      limit(slack_[i], slack_step_[i]);
      limit(dual_[i], dual_step_[i]);
      if (!is_soft(i)) continue;
      limit(excess_[i], excess_step_[i]);
      limit(sides_[i].price - dual_[i], -dual_step_[i]);
    }
    return length;
  }
  // Mean product of what must vanish against each other, after a step of this length.
  double complementarity(double length) const {
    double sum = 0, terms = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const double dual = dual_[i] + length * dual_step_[i];
      sum += (slack_[i] + length * slack_step_[i]) * dual;
      ++terms;
      if (!is_soft(i)) continue;
      sum += (excess_[i] + length * excess_step_[i]) * (sides_[i].price - dual);
      ++terms;
    }
    return sum / terms;
  }

  void residuals() {
    dual_residual_.assign(count_, 0.0);
    for (std::size_t i = 0; i < count_; ++i) {
      double value = diagonal_[i] * x_[i] - pull_[i];
      if (i >= dims_) value -= smoothness_ * x_[i - dims_];
      if (i + dims_ < count_) value -= smoothness_ * x_[i + dims_];
      dual_residual_[i] = value;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      add_side(sides_[i], dual_[i], dual_residual_);
      primal_residual_[i] = side_value(sides_[i], x_) + slack_[i] - excess_[i] - sides_[i].limit;
    }
  }

  // d dual / d side value: 1 / (slack / dual + excess / (price - dual)).
  double stiffness(std::size_t i) const {
    double give = slack_[i] / dual_[i];
    if (is_soft(i)) give += excess_[i] / (sides_[i].price - dual_[i]);
    return 1 / give;
  }

  bool factor() {
    matrix_.clear();
    for (std::size_t i = 0; i < count_; ++i) {
      matrix_.row(i)[dims_] = diagonal_[i];
      if (i >= dims_) matrix_.row(i)[0] = -smoothness_;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const double weight = stiffness(i);
      const Side& side = sides_[i];
      if (side.kind == Side::Kind::row) {
        for (std::size_t a = 0; a < dims_; ++a)
          for (std::size_t b = 0; b <= a; ++b)
            matrix_.row(side.first + a)[dims_ + b - a] += weight * side.row[a] * side.row[b];
        continue;
      }
      matrix_.row(side.first)[dims_] += weight;
      if (side.kind == Side::Kind::box) continue;
      matrix_.row(side.first - dims_)[dims_] += weight;
      matrix_.row(side.first)[0] -= weight;
    }
    return matrix_.factor();
  }

  // Newton direction that takes slack_product_ off slack * dual and excess_product_ off excess * (price - dual).
  void direction(std::vector<double>& step) {
    step.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) step[i] = -dual_residual_[i];
    for (std::size_t i = 0; i < sides_.size(); ++i) add_side(sides_[i], -stiffness(i) * offset(i), step);
    matrix_.solve(step);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      dual_step_[i] = stiffness(i) * (side_value(sides_[i], step) + offset(i));
      slack_step_[i] = -(slack_product_[i] + slack_[i] * dual_step_[i]) / dual_[i];
      excess_step_[i] =
          is_soft(i) ? (excess_[i] * dual_step_[i] - excess_product_[i]) / (sides_[i].price - dual_[i]) : 0;
    }
  }
  double offset(std::size_t i) const {
    double value = primal_residual_[i] - slack_product_[i] / dual_[i];
    if (is_soft(i)) value += excess_product_[i] / (sides_[i].price - dual_[i]);
    return value;
  }

  std::size_t dims_, count_;
  double smoothness_;
  BandMatrix matrix_;
  std::vector<double> diagonal_, pull_;
  std::vector<Side> sides_;
  std::vector<double> x_, slack_, dual_, excess_, slack_step_, dual_step_, excess_step_;
  std::vector<double> slack_product_, excess_product_, dual_residual_, primal_residual_;
};

}  // namespace

BoundedTrajectory solve_bounded_trajectory(const TrajectoryTargets& targets, double smoothness,
                                           const std::vector<FrameBound>& bounds, const TrajectoryEnds& ends,
                                           const StepBound& steps) {
  const std::size_t count = targets.frames * targets.dims;
  check(targets.precision.size() == count && targets.target.size() == count, "precision has ", targets.precision.size(),
        " values and target ", targets.target.size(), ", expected ", targets.frames, " x ", targets.dims, " = ", count);
  for (const FrameBound& bound : bounds)
    check(bound.frame < targets.frames && bound.row.size() == targets.dims, "a bound on frame ", bound.frame, " has ",
          bound.row.size(), " coefficients, expected a frame below ", targets.frames, " and ", targets.dims);
  if (count == 0) return {{}, true, 0};
  return InteriorPoint(targets, smoothness, bounds, ends, steps).solve();
}

}  // namespace face::trajectory
