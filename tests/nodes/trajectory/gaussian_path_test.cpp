// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/gaussian_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nodes/base/random.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::trajectory;

TEST(GaussianPath, MeetsTheEquationsOfItsMinimum) {
  Random random(5);
  Matrix means{40, 3, {}}, variances{40, 3, {}};
  for (int i = 0; i < 120; ++i) {
    means.values.push_back(random.normal());
    variances.values.push_back(random.uniform(0.01, 2));
  }
  const Matrix path = gaussian_path(means, variances, {7});
  for (std::size_t t = 0; t < 40; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      double slope = (path.at(t, k) - means.at(t, k)) / variances.at(t, k);
      if (t > 0) slope += 7 * (path.at(t, k) - path.at(t - 1, k));
      if (t < 39) slope += 7 * (path.at(t, k) - path.at(t + 1, k));
      EXPECT_NEAR(slope, 0, 1e-12);
    }
}

TEST(GaussianPath, DecaysFromATargetAsTheTimeConstantSays) {
  // tau = sqrt(lambda) sigma frames, where that is long.
  Matrix means{401, 1, std::vector<double>(401, 0.0)}, variances{401, 1, std::vector<double>(401, 1.0)};
  means.values[200] = 1;
  const Matrix path = gaussian_path(means, variances, {100});
  EXPECT_NEAR(std::log(path.values[220] / path.values[240]), 2, 0.01);
}

TEST(GaussianPath, LeavesValuesOfInfiniteVarianceFree) {
  const double inf = std::numeric_limits<double>::infinity();
  const Matrix path = gaussian_path({3, 1, {0, 99, 4}}, {3, 1, {1e-12, inf, 1e-12}}, {1});
  EXPECT_NEAR(path.values[1], 2, 1e-9);
}

TEST(GaussianPath, RejectsShapesThatDifferAndVariancesThatAreNone) {
  EXPECT_THROW_TEXT(gaussian_path({2, 1, {0, 0}}, {1, 2, {1, 1}}),
                    "means is 2 x 1, variances is 1 x 2, expected the same shape");
  EXPECT_THROW_TEXT(gaussian_path({2, 1, {0}}, {2, 1, {1, 1}}), "means has 1 values, expected 2 x 1");
  EXPECT_THROW_TEXT(gaussian_path({2, 1, {0, 0}}, {2, 1, {1, 0}}),
                    "variances holds 0 in row 1 column 0, expected more than 0");
  // Was a path of NaN.
  EXPECT_THROW_TEXT(gaussian_path({2, 1, {0, 1}}, {2, 1, {1, 1e-320}}, {0}),
                    "variances holds 9.99989e-321 in row 1 column 0, expected more: it is so small that its inverse is "
                    "beyond all numbers");
  EXPECT_THROW_TEXT(gaussian_path({1, 2, {0, std::nan("")}}, {1, 2, {1, 1}}),
                    "means holds nan in row 0 column 1, expected finite numbers");
}

}  // namespace
