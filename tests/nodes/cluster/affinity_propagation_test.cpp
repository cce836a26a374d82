// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/affinity_propagation.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "nodes/cluster/affinity_dense.h"
#include "nodes/cluster/k_medoids.h"
#include "tests/nodes/cluster/planted_groups.h"
#include "tests/nodes/cluster/scikit_learn_exemplars.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::cluster;

AffinityPropagationResult run(const Matrix& points, const AffinityPropagationOptions& options = {}) {
  engine::Progress progress;
  return affinity_propagation(points, options, progress);
}

AffinityPropagationOptions at_price(double preference, AffinityMethod method, double damping = 0.9) {
  AffinityPropagationOptions options;
  options.method = method;
  options.rule = PreferenceRule::value;
  options.preference = preference;
  options.damping = damping;
  return options;
}

// As Frey and Dueck have it, in double precision with all three matrices.
std::vector<double> plain_exemplars(const Matrix& points, double preference, double damping, int iterations) {
  const std::size_t n = points.rows;
  std::vector<double> s(n * n), r(n * n, 0.0), a(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t d = 0; d < points.columns; ++d) s[i * n + k] -= std::pow(points.at(i, d) - points.at(k, d), 2);
      if (i == k) s[i * n + k] = preference;
    }
  for (int t = 0; t < iterations; ++t) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        double most = -1e300;
        for (std::size_t j = 0; j < n; ++j)
          if (j != k) most = std::max(most, a[i * n + j] + s[i * n + j]);
        r[i * n + k] = damping * r[i * n + k] + (1 - damping) * (s[i * n + k] - most);
      }
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < n; ++j)
          if (j != i && j != k) sum += std::max(0.0, r[j * n + k]);
        const double next = i == k ? sum : std::min(0.0, r[k * n + k] + sum);
        a[i * n + k] = damping * a[i * n + k] + (1 - damping) * next;
      }
  }
  std::vector<double> exemplars;
  for (std::size_t k = 0; k < n; ++k)
    if (r[k * n + k] + a[k * n + k] > 0) exemplars.push_back(static_cast<double>(k));
  return exemplars;
}

TEST(AffinityPropagation, FindsWhatScikitLearnFinds) {
  const Matrix points = test::planted_groups(2000, 10, 12, 4).points;
  AffinityPropagationOptions options;
  options.damping = 0.5;
  const AffinityPropagationResult least = run(points, options);
  EXPECT_TRUE(least.converged);
  EXPECT_EQ(least.exemplars.values, test::scikit_learn_minimum);
  // Single precision.
  EXPECT_NEAR(least.preference, test::scikit_learn_minimum_preference, 1e-3);
  options.rule = PreferenceRule::median;
  const AffinityPropagationResult middle = run(points, options);
  EXPECT_EQ(middle.exemplars.values, test::scikit_learn_median);
  // Its median counts every point's similarity to itself, 0, as well: one in 2000 of all.
  EXPECT_NEAR(middle.preference, test::scikit_learn_median_preference, 2);
}

TEST(AffinityPropagation, PassesTheMessagesOfTheThreeMatrices) {
  const Matrix points = test::planted_groups(60, 3, 6, 5).points;
  for (const int iterations : {1, 2, 3, 5, 9, 20, 60})
    for (const double damping : {0.5, 0.8}) {
      std::vector<std::size_t> all(60);
      for (std::size_t i = 0; i < 60; ++i) all[i] = i;
      Similarities similarities(points, all);
      engine::Progress progress;
      const Messages found = pass_messages(similarities, -150, {damping, iterations, 1000}, progress);
      std::vector<double> exemplars(found.exemplars.begin(), found.exemplars.end());
      const std::vector<double> expected = plain_exemplars(points, -150, damping, iterations);
      if (expected.empty()) continue;  // then the likeliest one stands in
      EXPECT_EQ(exemplars, expected) << iterations << " iterations, damping " << damping;
    }
}

TEST(AffinityPropagation, FindsPlantedGroupsOfAnySize) {
  const test::PlantedGroups planted = test::planted_groups(3000, 30, 12);
  for (const AffinityMethod method : {AffinityMethod::exact, AffinityMethod::pruned}) {
    const AffinityPropagationResult found = run(planted.points, at_price(-3000, method));
    EXPECT_TRUE(found.converged);
    ASSERT_EQ(found.exemplars.rows, 12u);
    for (std::size_t i = 0; i < planted.group.size(); ++i)
      EXPECT_EQ(found.labels.values[i], static_cast<double>(planted.group[i]));
    for (std::size_t g = 0; g < 12; ++g) EXPECT_EQ(found.exemplars.values[g], static_cast<double>(planted.centres[g]));
  }
}

TEST(AffinityPropagation, PrunedIsHardlyWorseThanExactAndNoWorseThanMedoids) {
  const Matrix points = test::planted_groups(2500, 8, 15, 6).points;  // groups that overlap
  const AffinityPropagationResult exact = run(points, at_price(-4000, AffinityMethod::exact));
  const AffinityPropagationResult pruned = run(points, at_price(-4000, AffinityMethod::pruned));
  EXPECT_GT(pruned.similarity, exact.similarity - 0.005 * std::abs(exact.similarity))
      << pruned.exemplars.rows << " groups, exactly " << exact.exemplars.rows;
  KMedoidsOptions options;
  options.groups = static_cast<std::int64_t>(pruned.exemplars.rows);
  const double medoids = -k_medoids(points, options).error - 4000 * static_cast<double>(pruned.exemplars.rows);
  EXPECT_GE(pruned.similarity, medoids);
}

TEST(AffinityPropagation, IsBitForBitTheSameOnOneThread) {
  const Matrix points = test::planted_groups(1500, 10, 9, 5).points;
  for (const AffinityMethod method : {AffinityMethod::exact, AffinityMethod::pruned}) {
    const AffinityPropagationResult many = run(points, at_price(-1000, method));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const AffinityPropagationResult single = run(points, at_price(-1000, method));
    EXPECT_EQ(single.exemplars.values, many.exemplars.values);
    EXPECT_EQ(single.labels.values, many.labels.values);
    EXPECT_EQ(single.similarity, many.similarity);
    EXPECT_EQ(single.iterations, many.iterations);
  }
}

TEST(AffinityPropagation, IsUnchangedWhenPointsMoveAndGrow) {
  test::PlantedGroups planted = test::planted_groups(400, 5, 6, 3);
  const AffinityPropagationResult here = run(planted.points);
  for (double& value : planted.points.values) value = 64 * value + 4096;  // powers of two
  const AffinityPropagationResult there = run(planted.points);
  EXPECT_EQ(there.exemplars.values, here.exemplars.values);
  EXPECT_NEAR(there.similarity / here.similarity, 4096, 0.01);
}

TEST(AffinityPropagation, MakesGroupsCheaperInAShortClipWhereTheirPriceIsScaled) {
  const Matrix planted = test::planted_groups(120, 6, 8, 4).points;
  AffinityPropagationOptions options;
  options.rule = PreferenceRule::scaled;
  const auto scaled = run(planted, options), plain = run(planted);
  EXPECT_NEAR(scaled.preference, plain.preference * 120 / 18000, -1e-6 * plain.preference);
  EXPECT_GT(scaled.exemplars.rows, plain.exemplars.rows);
}

// Damped messages build up slowly: at first few points seem to stand for all others, and for a while always the same.
TEST(AffinityPropagation, DoesNotTakeTheBeginningOfTheMessagesForTheirEnd) {
  Matrix path{150, 4, {}};  // of a mouth that moves evenly, nearly every place twice
  for (std::size_t t = 0; t < path.rows; ++t)
    for (std::size_t d = 0; d < path.columns; ++d)
      path.values.push_back(10 * std::sin(0.2 * static_cast<double>((d + 1) * (t / 2)) + static_cast<double>(d)) +
                            0.1 * std::sin(static_cast<double>(t * t)));
  AffinityPropagationOptions options;
  options.rule = PreferenceRule::scaled;
  const auto settled = run(path, options);
  EXPECT_TRUE(settled.converged);
  options.improve = true;
  const auto best = run(path, options);
  EXPECT_GT(settled.similarity, 2.5 * best.similarity);
}

// A film of 25 frames a second shown at 50: every mouth is there twice, hardly different.
TEST(AffinityPropagation, GroupsTheFramesOfAFilmThatIsShownTwiceAsFastAsBefore) {
  Matrix once = test::planted_groups(75, 8, 30, 1).points, twice = once;
  for (const double apart : {0.0, 0.01}) {
    twice.rows = 0;
    twice.values.clear();
    for (std::size_t i = 0; i < once.rows; ++i)
      for (const double more : {0.0, apart}) {
        ++twice.rows;
        for (std::size_t d = 0; d < once.columns; ++d)
          twice.values.push_back(once.at(i, d) + (d == i % once.columns ? more : 0));
      }
    const double price = -40;
    AffinityPropagationOptions options = at_price(price, AffinityMethod::exact);
    options.improve = true;
    const auto slow = run(once, options);
    options.preference *= 2;
    const auto fast = run(twice, options);
    EXPECT_EQ(fast.exemplars.rows, slow.exemplars.rows) << "twins " << apart << " apart";
    EXPECT_NEAR(fast.similarity, 2 * slow.similarity, 0.02 * std::abs(slow.similarity))
        << "twins " << apart << " apart";
  }
}

TEST(AffinityPropagation, MakesOneGroupOfOnePoint) {
  for (const std::size_t count : {1, 2, 50}) {
    const AffinityPropagationResult found = run({count, 2, std::vector<double>(2 * count, 7.0)});
    EXPECT_TRUE(found.converged);
    EXPECT_EQ(found.exemplars.rows, 1u);
    EXPECT_EQ(found.labels.values, std::vector<double>(count, 0.0));
  }
}

TEST(AffinityPropagation, SaysWhereItDidNotSettle) {
  AffinityPropagationOptions options;
  options.max_iterations = 10;
  const AffinityPropagationResult found = run(test::planted_groups(300, 5, 6).points, options);
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.iterations, 10);
  EXPECT_EQ(found.labels.rows, 300u);
}

TEST(AffinityPropagation, RejectsPointsThatAreNone) {
  EXPECT_THROW_TEXT(run({0, 3, {}}), "points has no rows, expected at least one point");
  EXPECT_THROW_TEXT(run({2, 1, {1, std::nan("")}}),
                    "points holds nan in row 1 column 0, expected finite numbers of at most 1e15 in size");
  // One group of all points, as all distances were infinite.
  EXPECT_THROW_TEXT(run({2, 1, {1, 1e200}}),
                    "points holds 1e+200 in row 1 column 0, expected finite numbers of at most 1e15 in size");
}

}  // namespace
