// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/base/nnls.h"
#include "nodes/base/random.h"
#include "nodes/weights/least_squares.h"
#include "nodes/weights/nnls.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::weights;

Matrix random_matrix(std::size_t rows, std::size_t columns, std::uint64_t seed) {
  Random random(seed);
  Matrix matrix{rows, columns, std::vector<double>(rows * columns)};
  for (double& value : matrix.values) value = random.normal();
  return matrix;
}

// targets = weights basis'
Matrix targets_of(const Matrix& basis, const Matrix& weights) {
  Matrix targets{weights.rows, basis.rows, std::vector<double>(weights.rows * basis.rows)};
  for (std::size_t n = 0; n < weights.rows; ++n)
    for (std::size_t m = 0; m < basis.rows; ++m)
      for (std::size_t k = 0; k < basis.columns; ++k) targets.at(n, m) += basis.at(m, k) * weights.at(n, k);
  return targets;
}

double energy_of(const Matrix& basis, const double* target, const double* weights) {
  double energy = 0;
  for (std::size_t m = 0; m < basis.rows; ++m) {
    double rest = target[m];
    for (std::size_t k = 0; k < basis.columns; ++k) rest -= basis.at(m, k) * weights[k];
    energy += rest * rest;
  }
  return energy;
}

// The least energy over all subsets of columns whose own solution is not negative.
double least_energy(const Matrix& basis, const Matrix& target, bool sum_to_one) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t set = 0; set < std::size_t{1} << basis.columns; ++set) {
    std::vector<std::size_t> used;
    for (std::size_t k = 0; k < basis.columns; ++k)
      if (set >> k & 1) used.push_back(k);
    std::vector<double> weights(basis.columns, 0.0);
    if (used.empty()) {
      if (sum_to_one) continue;
    } else {
      Matrix part{basis.rows, used.size(), {}};
      for (std::size_t m = 0; m < basis.rows; ++m)
        for (const std::size_t k : used) part.values.push_back(basis.at(m, k));
      LeastSquaresOptions options;
      options.sum_to_one = sum_to_one;
      const LeastSquaresResult found = least_squares(part, target, nullptr, options);
      for (std::size_t i = 0; i < used.size(); ++i) weights[used[i]] = found.weights.values[i];
    }
    if (*std::min_element(weights.begin(), weights.end()) < 0) continue;
    least = std::min(least, energy_of(basis, target.values.data(), weights.data()));
  }
  return least;
}

TEST(Nnls, FindsWeightsThatMadeTheTargets) {
  const Matrix basis = random_matrix(30, 7, 1);
  Matrix weights = random_matrix(200, 7, 2);
  for (double& value : weights.values) value = std::max(0.0, value);
  const NnlsResult found = nnls(basis, targets_of(basis, weights), nullptr);
  for (std::size_t i = 0; i < weights.values.size(); ++i)
    EXPECT_NEAR(found.weights.values[i], weights.values[i], 1e-12);
  EXPECT_LT(found.kkt_residual, 1e-14);
  EXPECT_LT(found.rms, 1e-13);
}

TEST(Nnls, IsTheBestOfAllSubsetsOfShapes) {
  const Matrix basis = random_matrix(9, 6, 3), targets = random_matrix(60, 9, 4);
  for (const bool sum_to_one : {false, true}) {
    NnlsOptions options;
    options.sum_to_one = sum_to_one;
    const NnlsResult found = nnls(basis, targets, nullptr, options);
    EXPECT_LT(found.kkt_residual, 1e-13);
    for (std::size_t n = 0; n < targets.rows; ++n) {
      const double* target = &targets.values[n * 9];
      const double* weights = &found.weights.values[n * 6];
      double sum = 0;
      for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_GE(weights[k], 0);
        sum += weights[k];
      }
      if (sum_to_one) {
        EXPECT_NEAR(sum, 1, 1e-12);
      }
      const Matrix one{1, 9, std::vector<double>(target, target + 9)};
      EXPECT_NEAR(energy_of(basis, target, weights), least_energy(basis, one, sum_to_one), 1e-10);
    }
  }
}

TEST(Nnls, IsBitForBitTheSameFromAnyStart) {
  const Matrix basis = random_matrix(12, 7, 5), targets = random_matrix(100, 12, 6);
  const NnlsResult found = nnls(basis, targets, nullptr);
  for (std::size_t n = 0; n < targets.rows; ++n) {
    NonNegativeLeastSquares cold(basis);
    std::vector<double> weights(7);
    cold.solve(&targets.values[n * 12], weights.data());
    EXPECT_EQ(weights, std::vector<double>(found.weights.values.begin() + static_cast<std::ptrdiff_t>(7 * n),
                                           found.weights.values.begin() + static_cast<std::ptrdiff_t>(7 * n + 7)));
  }
}

TEST(Nnls, ScalesWithItsTargets) {
  const Matrix basis = random_matrix(12, 5, 7);
  Matrix targets = random_matrix(20, 12, 8);
  const NnlsResult here = nnls(basis, targets, nullptr);
  for (double& value : targets.values) value *= 1000;
  const NnlsResult there = nnls(basis, targets, nullptr);
  for (std::size_t i = 0; i < here.weights.values.size(); ++i)
    EXPECT_NEAR(there.weights.values[i], 1000 * here.weights.values[i], 1e-9);
}

TEST(Nnls, SubtractsTheNeutralShapeFromBoth) {
  Matrix basis = random_matrix(10, 4, 9), weights = random_matrix(30, 4, 10);
  for (double& value : weights.values) value = std::abs(value);
  Matrix targets = targets_of(basis, weights);
  const Matrix neutral = random_matrix(10, 1, 11);
  for (std::size_t m = 0; m < 10; ++m) {
    for (std::size_t k = 0; k < 4; ++k) basis.at(m, k) += neutral.values[m];
    for (std::size_t n = 0; n < 30; ++n) targets.at(n, m) += neutral.values[m];
  }
  for (const NnlsResult& found : {nnls(basis, targets, &neutral)})
    for (std::size_t i = 0; i < weights.values.size(); ++i)
      EXPECT_NEAR(found.weights.values[i], weights.values[i], 1e-12);
  const LeastSquaresResult free = least_squares(basis, targets, &neutral);
  for (std::size_t i = 0; i < weights.values.size(); ++i) EXPECT_NEAR(free.weights.values[i], weights.values[i], 1e-12);
}

TEST(Nnls, SolvesShapesThatDependOnEachOther) {
  Matrix basis = random_matrix(10, 6, 12);
  for (std::size_t m = 0; m < 10; ++m) {
    basis.at(m, 4) = basis.at(m, 1);
    basis.at(m, 5) = 0.5 * basis.at(m, 0) + 0.5 * basis.at(m, 2);
  }
  const Matrix targets = random_matrix(50, 10, 13);
  Matrix independent{10, 5, {}};
  for (std::size_t m = 0; m < 10; ++m)
    for (const std::size_t k : {0, 1, 2, 3, 5}) independent.values.push_back(basis.at(m, k));
  for (const bool sum_to_one : {false, true}) {
    const NnlsResult found = nnls(basis, targets, nullptr, {sum_to_one});
    EXPECT_LT(found.kkt_residual, 1e-10);
    for (std::size_t n = 0; n < 50; ++n) {
      const Matrix one{1, 10, std::vector<double>(&targets.values[10 * n], &targets.values[10 * n] + 10)};
      EXPECT_NEAR(energy_of(basis, one.values.data(), &found.weights.values[6 * n]),
                  least_energy(independent, one, sum_to_one), 1e-9);
    }
  }
}

TEST(Nnls, GivesNoWeightToAShapeOfZeros) {
  Matrix basis = random_matrix(5, 2, 14);
  for (std::size_t m = 0; m < 5; ++m) basis.at(m, 1) = 0;
  const NnlsResult found = nnls(basis, random_matrix(4, 5, 15), nullptr);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(found.weights.at(n, 1), 0);
  EXPECT_EQ(nnls(basis, {0, 5, {}}, nullptr).weights.rows, 0u);
}

TEST(Nnls, RejectsShapesThatDoNotFitAndNumbersThatAreNone) {
  Matrix basis = random_matrix(5, 3, 16);
  EXPECT_THROW_TEXT(nnls(basis, random_matrix(4, 6, 1), nullptr),
                    "targets has 6 columns, expected 5 as basis has rows");
  const Matrix neutral = random_matrix(4, 1, 1);
  EXPECT_THROW_TEXT(nnls(basis, random_matrix(4, 5, 1), &neutral),
                    "neutral has 4 numbers, expected 5 as basis has rows");
  EXPECT_THROW_TEXT(nnls(random_matrix(5, 64, 1), random_matrix(4, 5, 1), nullptr),
                    "basis has 64 columns, expected 1 to 63");
  basis.at(2, 1) = std::nan("");
  EXPECT_THROW_TEXT(nnls(basis, random_matrix(4, 5, 1), nullptr),
                    "basis holds nan in row 2 column 1, expected finite numbers");
}

TEST(LeastSquares, FitsAtLeastAsWellWithWeightsOfAnySign) {
  const Matrix basis = random_matrix(12, 5, 17), targets = random_matrix(40, 12, 18);
  const LeastSquaresResult free = least_squares(basis, targets, nullptr);
  EXPECT_LT(free.rms, nnls(basis, targets, nullptr).rms);
  EXPECT_TRUE(free.full);
  EXPECT_LT(*std::min_element(free.weights.values.begin(), free.weights.values.end()), -0.1);
  // What is left is at right angles to every shape.
  for (std::size_t n = 0; n < 40; ++n)
    for (std::size_t k = 0; k < 5; ++k) {
      double along = 0;
      for (std::size_t m = 0; m < 12; ++m) {
        double rest = targets.at(n, m);
        for (std::size_t j = 0; j < 5; ++j) rest -= basis.at(m, j) * free.weights.at(n, j);
        along += rest * basis.at(m, k);
      }
      EXPECT_NEAR(along, 0, 1e-12);
    }
}

TEST(LeastSquares, TakesTheShortestWeightsOfDependentShapes) {
  const Matrix basis{2, 2, {1, 1, 0, 0}};
  const LeastSquaresResult found = least_squares(basis, {1, 2, {4, 9}}, nullptr);
  EXPECT_FALSE(found.full);
  EXPECT_NEAR(found.weights.values[0], 2, 1e-12);
  EXPECT_NEAR(found.weights.values[1], 2, 1e-12);
}

}  // namespace
