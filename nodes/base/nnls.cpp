// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/nnls.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"

namespace face {
namespace {

// Inverse of a symmetric positive definite n x n matrix by Cholesky's method; false where it is not (to working
// precision).
bool invert(std::vector<double> a, std::size_t n, std::vector<double>& inverse) {
  constexpr double smallest = 1e-13;  // pivot, relative to the diagonal: below it is rounding
  for (std::size_t j = 0; j < n; ++j) {
    const double diagonal = a[j * n + j];
    for (std::size_t i = j; i < n; ++i) {
      double sum = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      if (i == j) {
        if (!(sum > smallest * diagonal)) return false;
        a[j * n + j] = std::sqrt(sum);
      } else {
        a[i * n + j] = sum / a[j * n + j];
      }
    }
  }
  inverse.assign(n * n, 0.0);
  for (std::size_t c = 0; c < n; ++c) {
    std::vector<double> x(n, 0.0);
    x[c] = 1;
    for (std::size_t i = c; i < n; ++i) {
      for (std::size_t k = c; k < i; ++k) x[i] -= a[i * n + k] * x[k];
      x[i] /= a[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = i + 1; k < n; ++k) x[i] -= a[k * n + i] * x[k];
      x[i] /= a[i * n + i];
    }
    for (std::size_t i = 0; i < n; ++i) inverse[i * n + c] = x[i];
  }
  return true;
}

}  // namespace

NonNegativeLeastSquares::NonNegativeLeastSquares(const Matrix& basis, bool sum_to_one)
    : rows_(basis.rows), columns_(basis.columns), sum_to_one_(sum_to_one), basis_(basis.values) {
  check(columns_ >= 1 && columns_ <= 63, "basis has ", columns_, " columns, expected 1 to 63");
  check(basis.values.size() == rows_ * columns_, "basis holds ", basis.values.size(), " numbers, expected ", rows_,
        " x ", columns_);
  for (const double value : basis_) check(std::isfinite(value), "basis holds ", value, ", expected finite numbers");
  gram_.assign(columns_ * columns_, 0.0);
  for (std::size_t m = 0; m < rows_; ++m)
    for (std::size_t i = 0; i < columns_; ++i)
      for (std::size_t j = 0; j < columns_; ++j)
        gram_[i * columns_ + j] += basis_[m * columns_ + i] * basis_[m * columns_ + j];
  for (const double value : gram_) gram_size_ = std::max(gram_size_, std::abs(value));
  right_.resize(columns_);
  trial_.resize(columns_);
}

const NonNegativeLeastSquares::Factor& NonNegativeLeastSquares::factor(std::uint64_t used) {
  if (last_ != nullptr && used == last_used_) return *last_;
  constexpr std::size_t most_kept = 4096;
  if (factors_.size() > most_kept) factors_.clear();
  const auto [place, is_new] = factors_.try_emplace(used);
  Factor& made = place->second;
  if (is_new) {
    for (std::size_t k = 0; k < columns_; ++k)
      if (used >> k & 1) made.used.push_back(k);
    const std::size_t n = made.used.size();
    std::vector<double> a(n * n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) a[i * n + j] = gram_[made.used[i] * columns_ + made.used[j]];
    made.regular = invert(std::move(a), n, made.inverse);
    if (made.regular && sum_to_one_) {
      double sum = 0;
      made.share.assign(n, 0.0);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) made.share[i] += made.inverse[i * n + j];
      for (const double value : made.share) sum += value;
      made.regular = n > 0 && sum > 0;
      for (double& value : made.share) value /= sum;
    }
  }
  last_ = &made;
  last_used_ = used;
  return made;
}

// The unconstrained minimum over the columns in use. False where they depend on each other.
bool NonNegativeLeastSquares::try_set(std::uint64_t used, double* weights, double& multiplier) {
  const Factor& set = factor(used);
  if (!set.regular) return false;
  const std::size_t n = set.used.size();
  std::fill(weights, weights + columns_, 0.0);
  multiplier = 0;
  // Twice: the second takes off what the first left through rounding.
  for (int pass = 0; pass < 2; ++pass) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = set.used[i];
      double rest = right_[k] - multiplier;
      if (pass > 0)
        for (std::size_t j = 0; j < n; ++j) rest -= gram_[k * columns_ + set.used[j]] * weights[set.used[j]];
      trial_[i] = rest;
      sum += weights[k];
    }
    double moved = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double step = 0;
      for (std::size_t j = 0; j < n; ++j) step += set.inverse[i * n + j] * trial_[j];
      weights[set.used[i]] += step;
      moved += step;
    }
    if (!sum_to_one_) continue;
    // The multiplier that brings the sum to one: inverse x 1 = share x (its sum).
    double total = 0;
    for (const double value : set.inverse) total += value;
    const double excess = sum + moved - 1;
    multiplier += excess / total;
    for (std::size_t i = 0; i < n; ++i) weights[set.used[i]] -= excess * set.share[i];
  }
  return true;
}

// Of -1/2 of the energy along a column, less the multiplier: > 0 where more of it would help.
double NonNegativeLeastSquares::slope(std::size_t column, const double* weights, double multiplier) const {
  double sum = right_[column] - multiplier;
  for (std::size_t j = 0; j < columns_; ++j) sum -= gram_[column * columns_ + j] * weights[j];
  return sum;
}

bool NonNegativeLeastSquares::exchange_blocks(double* weights) {
  std::uint64_t used = used_ == 0 && sum_to_one_ ? (std::uint64_t{1} << columns_) - 1 : used_;
  // Exchanging everything may run in circles: after some rounds without fewer violations it is given up.
  std::size_t fewest = columns_ + 1, patience = 3;
  for (;;) {
    if (!try_set(used, weights, multiplier_)) return false;
    std::uint64_t wrong = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < columns_; ++k) {
      const bool in_use = used >> k & 1;
      if (in_use ? weights[k] < 0 : slope(k, weights, multiplier_) > tolerance_) {
        wrong |= std::uint64_t{1} << k;
        ++count;
      }
    }
    if (count == 0) {
      used_ = used;
      return true;
    }
    if (count < fewest) {
      fewest = count;
      patience = 3;
    } else if (patience-- == 0) {
      return false;
    }
    used ^= wrong;
    if (sum_to_one_ && used == 0) return false;
  }
}

void NonNegativeLeastSquares::exchange_singly(double* weights) {
  std::vector<double> current(columns_, 0.0);
  std::uint64_t used = 0, refused = 0;
  double multiplier = 0;
  if (sum_to_one_) {
    // From the corner with the least energy.
    std::size_t best = 0;
    double least = 0;
    for (std::size_t k = 0; k < columns_; ++k) {
      const double energy = gram_[k * columns_ + k] - 2 * right_[k];
      if (k > 0 && energy >= least) continue;
      best = k;
      least = energy;
    }
    used = std::uint64_t{1} << best;
    current[best] = 1;
    multiplier = right_[best] - gram_[best * columns_ + best];
  }
  const std::size_t most_rounds = 10 * columns_ + 10;
  for (std::size_t round = 0; round < most_rounds; ++round) {
    std::size_t enters = columns_;
    double steepest = tolerance_;
    for (std::size_t k = 0; k < columns_; ++k) {
      if ((used | refused) >> k & 1) continue;
      const double along = slope(k, current.data(), multiplier);
      if (along <= steepest) continue;
      steepest = along;
      enters = k;
    }
    if (enters == columns_) break;
    const std::uint64_t before = used;
    used |= std::uint64_t{1} << enters;
    // Towards the minimum over the columns in use, dropping those that reach 0 on the way.
    bool dependent = false;
    for (;;) {
      double next_multiplier = 0;
      if (!try_set(used, weights, next_multiplier)) {
        dependent = true;
        break;
      }
      double length = 1;
      std::size_t leaves = columns_;
      for (std::size_t k = 0; k < columns_; ++k)
        if ((used >> k & 1) && weights[k] <= 0) {
          const double share = current[k] / (current[k] - weights[k]);
          if (current[k] - weights[k] > 0 && share < length) {
            length = share;
            leaves = k;
          }
        }
      for (std::size_t k = 0; k < columns_; ++k) current[k] += length * (weights[k] - current[k]);
      multiplier = next_multiplier;
      if (leaves == columns_) break;
      current[leaves] = 0;
      used &= ~(std::uint64_t{1} << leaves);
    }
    if (dependent || used == before) {
      // A column that those in use already make, or that rounding alone wanted.
      if (dependent) used &= ~(std::uint64_t{1} << enters);
      current[enters] = 0;
      refused |= std::uint64_t{1} << enters;
    } else {
      refused = 0;
    }
  }
  for (std::size_t k = 0; k < columns_; ++k) weights[k] = used >> k & 1 ? std::max(0.0, current[k]) : 0.0;
  used_ = used;
  multiplier_ = multiplier;
}

double NonNegativeLeastSquares::solve(const double* target, double* weights) {
  std::fill(right_.begin(), right_.end(), 0.0);
  for (std::size_t m = 0; m < rows_; ++m) {
    const double value = target[m];
    const double* row = &basis_[m * columns_];
    for (std::size_t k = 0; k < columns_; ++k) right_[k] += row[k] * value;
  }
  double right_size = 0;
  for (const double value : right_) right_size = std::max(right_size, std::abs(value));
  tolerance_ = 1e-13 * (right_size + (sum_to_one_ ? gram_size_ : 0));
  if (!exchange_blocks(weights)) exchange_singly(weights);

  double worst = 0, largest = 0;
  for (std::size_t k = 0; k < columns_; ++k) {
    const double along = slope(k, weights, multiplier_);
    worst = std::max(worst, weights[k] > 0 ? std::abs(along) : along);
    largest = std::max(largest, weights[k]);
  }
  const double size = gram_size_ * largest + right_size;
  return size > 0 ? worst / size : 0;
}

}  // namespace face
