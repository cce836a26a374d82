// SPDX-License-Identifier: Apache-2.0
// How track_video follows a head is tested in tests/nodes/texture, which can draw one.
#include "nodes/model/track_video.h"

#include <gtest/gtest.h>

#include "tests/nodes/model/material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

TEST(TrackVideo, PassesOnWhyTheStartIsNoUse) {
  FaceFit start;
  start.image_width_px = start.image_height_px = 64;
  start.problem = "too dark";
  const FaceFit fit = track_video(test::head_model(), test::blank(64, 64), start, {}, nullptr, {}).fit;
  EXPECT_FALSE(fit.converged);
  EXPECT_EQ(fit.problem, "the start could not be fitted: too dark");
}

TEST(TrackVideo, RejectsAFrameOfAnotherSize) {
  FaceFit start;
  start.image_width_px = start.image_height_px = 64;
  EXPECT_THROW_TEXT(track_video(test::head_model(), test::blank(32, 64), start, {}, nullptr, {}),
                    "the frame is 32 x 64 pixels, the start was fitted on 64 x 64");
}

TEST(TrackVideo, RejectsAPictureOfAnotherSize) {
  FaceFit start;
  start.image_width_px = start.image_height_px = 64;
  const Image picture = test::blank(64, 32);
  EXPECT_THROW_TEXT(track_video(test::head_model(), test::blank(64, 64), start, {}, &picture, {}),
                    "the picture is 64 x 32 pixels, the start was fitted on 64 x 64");
}

}  // namespace
