// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/mark_landmarks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "nodes/base/clip_points.h"
#include "nodes/decode/read_rig.h"
#include "nodes/phantom/make_head.h"
#include "nodes/types/arkit.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/folder_file.h"

namespace face::transfer {
namespace {

double distance_mm(const Vec3f& a, const Vec3f& b) {
  return std::hypot(static_cast<double>(a[0] - b[0]), static_cast<double>(a[1] - b[1]),
                    static_cast<double>(a[2] - b[2]));
}

// Every place p and offset o of the head as change(p, o).
template <class Change>
Rig changed(Rig rig, const Change& change) {
  for (Vec3f& p : rig.neutral.points_mm) p = change(p, false);
  for (Shape& shape : rig.shapes)
    for (Vec3f& o : shape.offsets_mm) o = change(o, true);
  return rig;
}

// As a file's head is read that says nothing of its face: three pairs of inner lips are found.
Rig unmarked(Rig rig) {
  rig.inner_lips.clear();
  for (std::size_t k = 0; k < 3; ++k) rig.inner_lips.push_back({rig.landmarks68[61 + k], rig.landmarks68[67 - k]});
  rig.landmarks68.clear();
  return rig;
}

double mean_error_mm(const Rig& found, const Rig& truth) {
  double sum = 0;
  for (const ClipPoint& point : clip_points)
    sum += distance_mm(found.neutral.points_mm[found.landmarks68[point.multi_pie]],
                       truth.neutral.points_mm[truth.landmarks68[point.multi_pie]]);
  return sum / static_cast<double>(clip_points.size());
}

TEST(MarkLandmarks, LeavesAHeadThatHasThemAsItIs) {
  const Rig head = phantom::make_head();
  EXPECT_EQ(mark_landmarks(head, head).landmarks68, head.landmarks68);
}

TEST(MarkLandmarks, FindsThoseOfAHeadOfAnotherSizeElsewhere) {
  const Rig reference = phantom::make_head();
  Rig truth = changed(reference, [](const Vec3f& v, bool offset) {
    return Vec3f{1.3f * v[0] + (offset ? 0 : 100), 1.3f * v[1] + (offset ? 0 : 1600), 1.3f * v[2]};
  });
  const Rig found = mark_landmarks(unmarked(truth), reference);
  ASSERT_EQ(found.landmarks68.size(), 68u);
  EXPECT_LT(mean_error_mm(found, truth), 1);
}

TEST(MarkLandmarks, FindsThoseOfANarrowHeadWithAWideMouth) {
  const Rig reference = phantom::make_head();
  const Rig truth = changed(reference, [](const Vec3f& v, bool offset) {
    const float mouth = offset ? 0 : std::exp(-(v[1] + 34) * (v[1] + 34) / 800);
    return Vec3f{(0.9f + 0.4f * mouth) * v[0], 1.1f * v[1], v[2]};
  });
  const Rig found = mark_landmarks(unmarked(truth), reference);
  EXPECT_LT(mean_error_mm(found, truth), 3);
  for (const std::size_t corner : {48u, 54u})
    EXPECT_LT(distance_mm(found.neutral.points_mm[found.landmarks68[corner]],
                          truth.neutral.points_mm[truth.landmarks68[corner]]),
              3)
        << corner;
}

TEST(MarkLandmarks, FindsThoseOfIctFaceKitToAFewMillimetres) {
  DATA_FILE(path, "ict-face/FaceXModel");
  const Rig truth = decode::read_rig(test::folder_file(path), nullptr);
  const Rig found = mark_landmarks(unmarked(truth), phantom::make_head());
  EXPECT_LT(mean_error_mm(found, truth), 4.5);
  for (const std::size_t inner : {61u, 62u, 63u, 65u, 66u, 67u})
    EXPECT_LT(distance_mm(found.neutral.points_mm[found.landmarks68[inner]],
                          truth.neutral.points_mm[truth.landmarks68[inner]]),
              3)
        << inner;
}

TEST(MarkLandmarks, SaysWhatAHeadLacks) {
  const Rig reference = phantom::make_head();
  const Rig head = unmarked(reference);
  EXPECT_THROW_TEXT(mark_landmarks(head, head), "the reference has 0 landmarks, expected 68");
  Rig blind = head;
  blind.shapes[arkit_index("eyeBlinkRight")] = {"eyeBlinkRight", {}, {}};
  EXPECT_THROW_TEXT(mark_landmarks(blind, reference),
                    "the rig's landmarks cannot be found: it has no shape eyeBlinkRight");
  Rig mute = head;
  mute.inner_lips.resize(1);
  EXPECT_THROW_TEXT(mark_landmarks(mute, reference),
                    "the rig's landmarks cannot be found: it has 1 pairs of inner lips, expected at least 3 that "
                    "jawOpen parts");
  const Rig turned = changed(head, [](const Vec3f& v, bool) { return Vec3f{-v[0], v[1], -v[2]}; });
  EXPECT_THROW(mark_landmarks(turned, reference), std::exception);
}

}  // namespace
}  // namespace face::transfer
