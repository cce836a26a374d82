// SPDX-License-Identifier: Apache-2.0
// The ways to find key shapes that affinity propagation is compared with, and what happens to its groups afterwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "nodes/base/random.h"
#include "nodes/cluster/gather_key_shapes.h"
#include "nodes/cluster/k_means.h"
#include "nodes/cluster/k_medoids.h"
#include "nodes/cluster/key_shapes_direct.h"
#include "nodes/cluster/landmark_points.h"
#include "nodes/cluster/merge.h"
#include "nodes/cluster/spread.h"
#include "tests/nodes/cluster/planted_groups.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::cluster;

std::vector<double> as_numbers(const std::vector<std::size_t>& values) { return {values.begin(), values.end()}; }

// How many groups of the truth have all their points under one label of their own.
std::size_t groups_found(const std::vector<std::size_t>& truth, const Matrix& labels, std::size_t groups) {
  std::size_t found = 0;
  for (std::size_t g = 0; g < groups; ++g) {
    std::set<double> inside, outside;
    for (std::size_t i = 0; i < truth.size(); ++i) (truth[i] == g ? inside : outside).insert(labels.values[i]);
    found += inside.size() == 1 && !outside.count(*inside.begin());
  }
  return found;
}

TEST(KMedoids, FindsPlantedGroups) {
  const test::PlantedGroups planted = test::planted_groups(600, 10, 5);
  KMedoidsOptions options;
  options.groups = 5;
  const KMedoidsResult found = k_medoids(planted.points, options);
  EXPECT_EQ(found.exemplars.values, as_numbers(planted.centres));
  EXPECT_EQ(found.labels.values, as_numbers(planted.group));
}

TEST(KMeans, FindsPlantedGroupsAndTheirCentres) {
  const test::PlantedGroups planted = test::planted_groups(600, 10, 3);
  KMeansOptions options;
  options.groups = 3;
  const KMeansResult found = k_means(planted.points, options);
  EXPECT_EQ(groups_found(planted.group, found.labels, 3), 3u);
  std::vector<double> exemplars = found.exemplars.values;
  std::sort(exemplars.begin(), exemplars.end());
  EXPECT_EQ(exemplars, as_numbers(planted.centres));
  EXPECT_LT(found.error, k_medoids(planted.points, {3, 10, 1}).error);
}

TEST(KMeans, RejectsMoreGroupsThanPoints) {
  EXPECT_THROW_TEXT(k_means({3, 1, {0, 1, 2}}, {4, 100, 1}),
                    "there are 3 points for 4 groups, expected at least one point per group");
  EXPECT_EQ(k_means({3, 1, {5, 5, 5}}, {3, 100, 1}).error, 0);
}

TEST(Spread, TakesTheEndsOfTheAxes) {
  Matrix points{5, 2, {0, 0, 10, 0, -10, 0, 0, 3, 0, -3}};
  EXPECT_EQ(spread(points, {2}).exemplars.values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(spread(points, {1}).exemplars.values, (std::vector<double>{1, 2}));
  EXPECT_EQ(spread({1, 2, {4, 5}}, {2}).exemplars.values, (std::vector<double>{0}));
}

// Points that weights >= 0 of three directions make, of which one is rare.
Matrix three_directions() {
  face::Random random(4);
  Matrix points{600, 6, {}};
  for (int i = 0; i < 600; ++i) {
    const double a = random.uniform(), b = random.uniform(), c = i % 30 == 0 ? random.uniform() : 0;
    for (const double value : {a, a + b, b, 2 * c, a - c, b + c}) points.values.push_back(10 * value);
  }
  return points;
}

TEST(KeyShapesDirect, ExplainsPointsThatAFewShapesMake) {
  const Matrix points = three_directions(), neutral{1, 6, std::vector<double>(6, 0.0)};
  const KeyShapesDirectResult found = key_shapes_direct(points, &neutral, {3, 300, 1});
  EXPECT_LT(found.error, 0.05);  // of values up to 20
  EXPECT_GT(key_shapes_direct(points, &neutral, {1, 50, 1}).error, 1);
  EXPECT_EQ(found.shapes.rows, 3u);
}

TEST(Merge, StopsAtTheNumberOfGroupsThatWerePlanted) {
  // Every group split in three.
  const test::PlantedGroups planted = test::planted_groups(900, 10, 7);
  KMedoidsOptions options;
  options.groups = 21;
  const KMedoidsResult split = k_medoids(planted.points, options);
  const Matrix neutral{1, 10, std::vector<double>(10, 0.0)};
  const MergeResult found = merge(planted.points, split.labels, split.exemplars, &neutral);
  EXPECT_NEAR(static_cast<double>(found.knee), 7, 1);
  ASSERT_EQ(found.curve.rows.size(), 21u);
  for (std::size_t row = 0; row < 20; ++row)
    EXPECT_LT(found.curve.rows[row + 1].values[2], found.curve.rows[row].values[2] * 1.2);
  const MergeResult seven = merge(planted.points, split.labels, split.exemplars, &neutral, {7, 0});
  EXPECT_EQ(seven.exemplars.rows, 7u);
  EXPECT_EQ(groups_found(planted.group, seven.labels, 7), 7u);
}

TEST(Merge, JoinsExemplarsThatAreNearWhateverTheError) {
  const Matrix points{4, 1, {0, 1, 100, 101}}, labels{4, 1, {0, 1, 2, 3}}, exemplars{4, 1, {0, 1, 2, 3}};
  const MergeResult found = merge(points, labels, exemplars, nullptr, {4, 2});
  EXPECT_EQ(found.exemplars.values, (std::vector<double>{0, 2}));
  EXPECT_EQ(found.labels.values, (std::vector<double>{0, 0, 1, 1}));
}

TEST(Merge, TakesMoreGroupsThanWeightsCanBeFoundFor) {
  const std::size_t count = 80;
  Matrix points{count, 2, {}}, labels{count, 1, {}}, exemplars{count, 1, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 0.07 * static_cast<double>(i);
    points.values.insert(points.values.end(), {10 * std::cos(angle), 10 * std::sin(angle)});
    labels.values.push_back(static_cast<double>(i));
    exemplars.values.push_back(static_cast<double>(i));
  }
  const MergeResult merged = merge(points, labels, exemplars, nullptr);
  EXPECT_EQ(merged.curve.rows.size(), 63u);
  EXPECT_LT(merged.exemplars.rows, 10u);  // a plane needs few
}

TEST(Merge, RejectsLabelsThatDoNotFit) {
  const Matrix points{2, 1, {0, 1}};
  EXPECT_THROW_TEXT(merge(points, {1, 1, {0}}, {1, 1, {0}}, nullptr),
                    "labels has 1 numbers, expected 2 as points has rows");
  EXPECT_THROW_TEXT(merge(points, {2, 1, {0, 1}}, {1, 1, {0}}, nullptr),
                    "labels holds 1, expected a whole number from 0 to 0");
}

Landmarks frame(double x, bool valid = true) { return {{{"lip_0", x, 2 * x, true}, {"lip_1", x + 1, 5, valid}}}; }

TEST(LandmarkPoints, LeavesOutFramesWithALostLandmark) {
  const engine::Seq<Landmarks> tracks({frame(0), frame(1, false), frame(2)}, {"10", "11", "12"});
  const LandmarkPointsResult found = landmark_points(tracks);
  EXPECT_EQ(found.points.rows, 2u);
  EXPECT_EQ(found.points.values, (std::vector<double>{0, 0, 1, 5, 2, 4, 3, 5}));
  EXPECT_EQ(found.frames.values, (std::vector<double>{0, 2}));
  EXPECT_EQ(landmark_points(tracks, {1}).frames.values, (std::vector<double>{0, 1, 2}));  // at its last good place
  const KeyShapes keys = gather_key_shapes(tracks, found.frames, {2, 1, {0, 1}}, {2, 1, {1, 0}});
  EXPECT_EQ(keys.shapes[0].frame, "12");
  EXPECT_EQ(keys.shapes[1].size, 1);
  // A film in which nobody is seen: "points has no rows", said affinity propagation.
  const Landmarks lost{{{"lip_0", 1, 2, false}, {"lip_6", 3, 4, false}}};
  EXPECT_THROW_TEXT(
      landmark_points(engine::Seq<Landmarks>({lost, lost}), {1}),
      "none of the 2 frames can be used: each has lost more than 1 of its 2 landmarks; does the film show "
      "the face that the points were placed on?");
  EXPECT_THROW_TEXT(landmark_points(engine::Seq<Landmarks>({frame(0), Landmarks{}})),
                    "frame 1 has 0 landmarks, expected 2 as frame 0");
}

}  // namespace
