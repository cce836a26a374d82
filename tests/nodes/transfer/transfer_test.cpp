// SPDX-License-Identifier: Apache-2.0
// The way of graphs/scan_stream/transfer.json from a neutral frame to other heads, against the truth of every vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/decode/read_identity_modes.h"
#include "nodes/decode/read_rig.h"
#include "nodes/phantom/identity_modes.h"
#include "nodes/phantom/make_head.h"
#include "nodes/transfer/fit_identity.h"
#include "nodes/transfer/judge_lips.h"
#include "nodes/transfer/look_up.h"
#include "nodes/transfer/project_cylinder.h"
#include "tests/nodes/transfer/speaker.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/folder_file.h"

namespace {

using namespace face;
using namespace face::transfer;

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values.empty() ? NAN : values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

double distance(const Vec3f& a, const Vec3f& b) {
  return static_cast<double>(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
}

struct Found {
  FitIdentityResult fit;
  SurfaceMap places;
};

Found find(const test::Speaker& speaker, const MorphableModel& model) {
  const ProjectCylinderResult cylinder = project_cylinder(speaker.mesh, speaker.rest, speaker.axis);
  Found found{fit_identity(model, cylinder.scan, &cylinder.marks), {}};
  found.places = look_up(model, found.fit.points, speaker.mesh, speaker.rest, speaker.axis);
  return found;
}

// Error of every vertex on another person's head, over several, and about the lips.
void judge(const test::Speaker& speaker, const Found& found, const Rig& rig, const ShapeSet& modes, int persons,
           double bar_mm) {
  std::vector<double> errors;
  for (int p = 0; p < persons; ++p) {
    const Rig other = phantom::make_person(rig, &modes, nullptr, {.seed = 100 + p}).person;
    const MeshPoints ours = resample(found.places, other, nullptr, nullptr, speaker.mesh, speaker.rest);
    const MeshPoints truth = resample(speaker.places, other, nullptr, nullptr, speaker.mesh, speaker.rest);
    std::vector<double> own;
    for (std::size_t v = 0; v < ours.points_mm.size(); ++v)
      if (speaker.places.triangle[v] >= 0) own.push_back(distance(ours.points_mm[v], truth.points_mm[v]));
    EXPECT_LE(quantile(own, 0.5), bar_mm) << "person " << p;
    errors.insert(errors.end(), own.begin(), own.end());
  }
  const Table lips = judge_lips(found.places, speaker.places, rig);
  EXPECT_LE(quantile(errors, 0.5), 0.5);  // far below the bar of a single head
  EXPECT_GT(lips.rows[0].values[0], 300);
  EXPECT_EQ(lips.rows[0].values[1], 0);
}

}  // namespace

TEST(Transfer, CarriesTheEmbeddedHeadsSpeakerToOtherHeads) {
  const Rig rig = phantom::make_head({.with_hair = false});
  const ShapeSet modes = phantom::identity_modes({.with_hair = false});
  const MorphableModel model =
      face::model::from_rig(rig, &modes, {.expressions = 1, .albedos = 0, .samples = 2, .skins = 0});
  for (const std::int64_t seed : {1, 2, 3}) {
    const test::Speaker speaker(rig, modes, seed, 0);
    const Found found = find(speaker, model);
    EXPECT_TRUE(found.fit.solved);
    judge(speaker, found, rig, modes, 4, 1.5);
  }
}

// Otherwise other heads have lids where eyes should be, and no brows.
TEST(Transfer, FindsEyesOnEyesAndBrowsOnBrows) {
  const Rig rig = phantom::make_head({.with_hair = false});
  const ShapeSet modes = phantom::identity_modes({.with_hair = false});
  const MorphableModel model =
      face::model::from_rig(rig, &modes, {.expressions = 1, .albedos = 0, .samples = 2, .skins = 0});
  const test::Speaker speaker(rig, modes, 1, 0);
  const Found found = find(speaker, model);
  const auto all = render::triangulate(rig.neutral, false);
  const auto is = [&](std::int32_t triangle, std::string_view word) {
    return triangle >= 0 && rig.neutral.parts[all.parts[static_cast<std::size_t>(triangle)]].name.starts_with(word);
  };
  for (const char* part : {"sclera", "iris", "brows"}) {
    double there = 0, same = 0;
    for (std::size_t v = 0; v < found.places.triangle.size(); ++v) {
      there += is(speaker.places.triangle[v], part);
      same += is(speaker.places.triangle[v], part) && is(found.places.triangle[v], part);
    }
    EXPECT_GT(there, 30) << part;
    EXPECT_GT(same, 0.8 * there) << part;
  }
}

TEST(Transfer, CarriesAnIctSpeakerToTenOtherHeads) {
  DATA_FILE(path, "ict-face/FaceXModel");
  const engine::File folder = test::folder_file(path);
  const Rig rig = decode::read_rig(folder, nullptr);
  const ShapeSet modes = decode::read_identity_modes(folder);
  const MorphableModel model =
      face::model::from_rig(rig, &modes, {.expressions = 1, .albedos = 0, .samples = 2, .skins = 0});
  for (const std::int64_t seed : {1, 2, 3}) {
    const test::Speaker speaker(rig, modes, seed, 0);
    const Found found = find(speaker, model);
    EXPECT_TRUE(found.fit.solved);
    judge(speaker, found, rig, modes, seed == 1 ? 10 : 2, 1.5);
  }
}
