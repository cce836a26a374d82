// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/compare_spaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "nodes/base/random.h"
#include "nodes/model/pose_model.h"
#include "tests/nodes/model/material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

// Orthonormal rows of random directions (Gram and Schmidt).
std::vector<std::vector<double>> directions(std::size_t count, std::size_t size) {
  Random random(3);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> row(size);
    for (double& x : row) x = random.normal();
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& other : rows) {
        double dot = 0;
        for (std::size_t k = 0; k < size; ++k) dot += row[k] * other[k];
        for (std::size_t k = 0; k < size; ++k) row[k] -= dot * other[k];
      }
    double squares = 0;
    for (const double x : row) squares += x * x;
    for (double& x : row) x /= std::sqrt(squares);
    rows.push_back(row);
  }
  return rows;
}

// Examples that lean out of the basis by these angles, each as long as its scale.
void plant(const std::vector<double>& angles_deg, const std::vector<double>& scales, Matrix& examples, Matrix& basis) {
  const std::size_t n = angles_deg.size(), size = 60;
  const auto axes = directions(2 * n, size);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = angles_deg[i] * std::numbers::pi / 180;
    for (std::size_t k = 0; k < size; ++k) {
      basis.values.push_back(axes[i][k] * 2);
      examples.values.push_back(scales[i] * (std::cos(angle) * axes[i][k] + std::sin(angle) * axes[n + i][k]));
    }
  }
  examples.rows = basis.rows = n;
  examples.columns = basis.columns = size;
}

TEST(CompareSpaces, ReproducesThePapersFiguresWhereTheyArePlanted) {
  for (const auto& [angle_deg, ratio] : {std::pair{74.0, 0.46}, std::pair{45.0, 0.15}}) {
    // One example at the angle, one inside the basis; their lengths make the ratio.
    const double sine2 = std::pow(std::sin(angle_deg * std::numbers::pi / 180), 2);
    Matrix examples, basis;
    plant({angle_deg, 0}, {1.0, std::sqrt(sine2 / ratio - 1)}, examples, basis);
    const SpaceComparison found = compare(examples, basis);
    EXPECT_NEAR(found.angles_deg.back(), angle_deg, 1e-6);
    EXPECT_NEAR(found.angles_deg.front(), 0, 1e-6);
    EXPECT_NEAR(found.residual_ratio, ratio, 1e-9);
  }
}

TEST(CompareSpaces, IsUnchangedWhenUnitsGrowAThousandfold) {
  Matrix examples, basis;
  plant({20, 50, 80}, {1, 2, 3}, examples, basis);
  const SpaceComparison before = compare(examples, basis);
  for (double& x : examples.values) x *= 1000;
  for (double& x : basis.values) x *= 1000;
  const SpaceComparison after = compare(examples, basis);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(before.angles_deg[i], after.angles_deg[i], 1e-6);
  EXPECT_NEAR(before.residual_ratio, after.residual_ratio, 1e-12);
}

TEST(CompareSpaces, CountsARepeatedBasisVectorOnce) {
  Matrix examples, basis;
  plant({30, 60}, {1, 1}, examples, basis);
  const SpaceComparison before = compare(examples, basis);
  const std::vector<double> again(basis.values.begin(), basis.values.begin() + 60);
  basis.values.insert(basis.values.end(), again.begin(), again.end());
  ++basis.rows;
  EXPECT_NEAR(compare(examples, basis).residual_ratio, before.residual_ratio, 1e-9);
}

TEST(CompareSpaces, TellsExpressionsFromIdentitiesOfAModel) {
  const Table table = compare_spaces(test::head_model());
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].name, "expression");
  EXPECT_GT(table.rows[0].values[0], 30);
  EXPECT_GT(table.rows[0].values[2], 0.05);
  EXPECT_LT(table.rows[0].values[2], 1.0);
}

TEST(CompareSpaces, RejectsSpacesOfOtherSizes) {
  Matrix a{1, 2, {1, 0}}, b{1, 3, {1, 0, 0}};
  EXPECT_THROW_TEXT(compare(a, b), "examples have 2 columns, the basis has 3");
}

TEST(CompareSpaces, RejectsModesThatAreNotOfTheMeshsVertices) {
  MorphableModel model;
  model.mean.points_mm.assign(3, {0, 0, 0});
  model.identity = {{"wide"}, {1}, {{1, 0, 0}, {1, 0, 0}}};
  EXPECT_THROW_TEXT(compare_spaces(model), "the model's 1 identity components have 2 offsets, expected 3 each");
}

}  // namespace
