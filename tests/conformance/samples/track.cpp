// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"
#include "nodes/types/timeline.h"
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

const Maker states = made([](int variant) {
  static const std::array<std::string, 6> all = {"start", "followed", "cut", "found", "even", "lost"};
  return all[static_cast<std::size_t>(variant) % all.size()];
});

// A face of 128 x 96 pixels that moves by a pixel from frame to frame, its mouth wider open and its chin lower in each;
// in the second a hand hides an eye and the tip of the nose has gone 7 px ahead.
const Maker clip = made([](int variant) {
  face::Image image{128, 96, 3, {}};
  const double open = 0.8 * variant;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double u = x - variant, v = y;
      const double grain = 12 * std::sin(0.95 * u + 0.35 * v) * std::cos(0.65 * v - 0.25 * u) +
                           14 * std::sin(0.31 * u - 0.1 * v) * std::sin(0.35 * v) +
                           4 * std::sin(12.9 * x + 78.2 * y + 37 * variant);  // of the camera
      double red = 170 + grain, green = 120 + grain, blue = 100 + grain;
      if (v > 88 + open - 0.012 * (u - 64) * (u - 64)) red = green = blue = 40 + 0.5 * grain;  // below the chin
      const double across = (u - 64) / 16, along = (v - 64) / (6 + open);
      if (across * across + along * along < 1) red = 160 + grain, green = 60 + grain, blue = 70;
      if (std::abs(v - 64) < 0.6 + open && std::abs(across) < 0.9) red = green = blue = 30;
      const double ahead = variant == 1 ? 7 : 0;
      if (std::hypot(u - 64 - ahead, v - 42) < 5) red = green = blue = 220 + 15 * std::sin(0.8 * u) * std::cos(v);
      for (const double eye : {52.0, 76.0})
        if (std::hypot(u - eye, v - 28) < 5) red = green = blue = 50 + 30 * std::cos(u + 0.5 * v);
      if (variant % 2 == 1 && std::hypot(x - 54, y - 28) < 12) red = 190, green = 150, blue = 130;
      for (const double value : {red, green, blue})
        image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)));
    }
  return image;
});
// On that face in the frame before the first.
const Maker first_points = made([](int variant) {
  const double by = 0.2 * variant;
  face::Landmarks landmarks{{{"eye_inner_r", 52 + by, 28, true}, {"eye_inner_l", 76, 28, true}}};
  landmarks.points.push_back({"nose_tip", 64 + by, 42, true});
  for (int i = 0; i < 12; ++i)
    landmarks.points.push_back(
        {"lip_" + std::to_string(i), 64 - 16 * std::cos(M_PI * i / 6), 64 - 6 * std::sin(M_PI * i / 6), true});
  landmarks.points.push_back({"jaw_r", 52, 86.3, true});
  landmarks.points.push_back({"chin", 64, 88 + by, true});
  landmarks.points.push_back({"jaw_l", 76, 86.3, true});
  return landmarks;
});
// Boxes farther to the right.
const Maker drifting_points = changed<face::Landmarks>(another("landmarks", 0), [](auto& landmarks, int variant) {
  for (face::Landmark& point : landmarks.points) point.x_px += 4 * variant;
});
const Maker depths = made([](int variant) {
  face::Matrix column{15, 1, {}};
  for (int i = 0; i < 15; ++i) column.values.push_back((1 + 0.3 * variant) * std::sin(1.1 * i));
  return column;
});

// A head that nods and turns a little.
const Maker head_pose = made([](int variant) {
  return face::Matrix{7, 1, {0.02 + 0.05 * variant, 0.03 - 0.04 * variant, 0.01, 0.01, 60, 40, 0.9}};
});

// One that nods and comes nearer by so much that its lips are of another thickness.
const Maker nodding_head = made([](int variant) {
  return face::Matrix{7, 1, {0.5 - 0.3 * variant, 0.1, 0, 0.3 * variant, 60, 40, 0.9}};
});

// A lamp that is turned on more and more.
const Maker light = made([](int variant) {
  return face::Matrix{3, 2, {1 - 0.1 * variant, 5, 1, -6.0 * variant, 1.1, 0}};
});

const Maker correction = made([](int variant) {
  return face::Landmarks{{{"lip_3", 65 + 0.5 * variant, 57 - 0.5 * variant, true}}};
});

const Maker nose_put_right = made([](int variant) {
  return face::Landmarks{{{"30", 30 + 0.5 * variant, 22 - 0.5 * variant, true}}};
});

// Four frames of which one is shown longer.
const Maker uneven_timeline = made([](int variant) {
  return face::Timeline{{0, 0.04, 0.08 + 0.02 * variant, 0.12 + 0.02 * variant}, 0.16 + 0.02 * variant};
});

// Frames of a mouth of which the second is shut, as far as its variant says, and the third nearly.
const Maker openings = made([](int variant) {
  const std::array<double, 4> all = {0.1, 0.006, 0.024, 0.05};
  return all[static_cast<std::size_t>(variant) % all.size()];
});

// The lips of these: the third's lower one is half behind the teeth.
const Maker parting_lips = made([](int variant) {
  const double lower_px = variant % 4 == 2 ? 7.75 : 12;
  face::Landmarks points;
  for (int k = 1; k <= 3; ++k) {
    points.points.push_back({"lip_" + std::to_string(k + 1), 10.0 * k, 20, true});
    points.points.push_back({"inner_lip_" + std::to_string(k), 10.0 * k, 28, true});
    points.points.push_back({"inner_lip_" + std::to_string(8 - k), 10.0 * k, 29, true});
    points.points.push_back({"lip_" + std::to_string(11 - k), 10.0 * k, 29 + lower_px, true});
  }
  return points;
});

// Of these.
const Maker lip_depths = made([](int variant) {
  face::Matrix column{12, 1, {}};
  for (int i = 0; i < 12; ++i) column.values.push_back((4 + 9.0 * variant) * std::sin(1.1 * i));
  return column;
});

// The same of a mouth that is open or nearly so, with thinner lips.
const Maker open_lips = made([](int variant) {
  face::Landmarks points;
  for (int k = 1; k <= 3; ++k) {
    const double upper_px = 6.5 + 0.5 * std::sin(1.3 * variant), gap_px = k == 2 ? 9 : 4.5;
    points.points.push_back({"lip_" + std::to_string(k + 1), 10.0 * k, 20, true});
    points.points.push_back({"inner_lip_" + std::to_string(k), 10.0 * k, 20 + upper_px - 0.3 * k, true});
    points.points.push_back({"inner_lip_" + std::to_string(8 - k), 10.0 * k, 20 + upper_px + gap_px, true});
    points.points.push_back({"lip_" + std::to_string(11 - k), 10.0 * k, 30 + upper_px + gap_px, true});
  }
  return points;
});

engine::ParamValue names(std::vector<std::string> list) { return list; }

const Registered track({
    .inputs =
        {
            {"track.stabilise.landmarks", speaker_points},
            {"track.stabilise.rest", speaker_points},
            {"track.find_rest.landmarks", speaker_points},
            {"track.klt.start", first_points},
            {"track.klt.frames", clip},
            {"track.klt.correction", correction},
            {"track.face_flow.start", drifting_points},
            {"track.stabilise.depths_px", depths},
            {"track.stabilise.head", head_pose},
            {"track.chain_flow.start", two_digit_points},
            {"track.chain_flow.correction", nose_put_right},
            {"track.chain_flow.from_first", another("flow_field", 2)},
            {"track.lip_colours.image", clip},
            {"track.lip_colours.landmarks", scattered(first_points, 2)},
            {"track.lip_colours.light", light},
            {"track.inner_lips.colours", made_by("track.lip_colours", "colours")},
            {"track.inner_lips.contrast", made_by("track.lip_colours", "contrast")},
            {"track.inner_lips.landmarks", first_points},
            {"track.inner_lips.rest", parting_lips},
            {"track.inner_lips.depths_px", lip_depths},
            {"track.inner_lips.head", nodding_head},
            {"track.lip_thickness.landmarks", open_lips},
            {"track.lip_thickness.rest", parting_lips},
            {"track.mouth_opening.colours", made_by("track.lip_colours", "colours")},
            {"track.mouth_opening.landmarks", scattered(first_points, 2)},
            {"track.find_contact.openings", openings},
            {"track.find_contact.landmarks", parting_lips},
            {"track.report.landmarks", losing_points(speaker_points)},
            {"track.report.state", states},
            {"track.report.timeline", uneven_timeline},
        },
    .params = {{"track.face_flow.margin", 0.1}},
    .values = {{"track.klt.max_return_error_px", {50.0}},
               {"track.chain_flow.names", {names({"30", "33"})}},
               {"track.find_rest.from_share", {0.5}},
               {"track.stabilise.rigid", {names({"eye_inner_r", "eye_inner_l"})}}},
    .settings = {{"track.find_rest", {{{"still_share", 1.0}, {"to_share", 1.0}}}},
                 {"track.klt",
                  {{{"largest_mouth_px", 20.0}, {"smallest_mouth_px", 5.0}, {"tracked_mouth_px", 16.0}},
                   {{"smallest_mouth_px", 5.0}, {"tracked_mouth_px", 16.0}},
                   {{"min_likeness", 0.99}},            // points go to edges, not to their patches
                   {{"max_return_error_px", 0.01}}}}},  // points are lost and looked for
});

}  // namespace
}  // namespace conformance
