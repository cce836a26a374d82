// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/timeline.h"
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

const Maker states = made([](int variant) {
  static const std::array<std::string, 6> all = {"start", "followed", "cut", "found", "even", "lost"};
  return all[static_cast<std::size_t>(variant) % all.size()];
});

// A mouth on a face that moves by a pixel from frame to frame, wider open in each; in every second frame a hand hides
// an eye, and in the second the tip of the nose has gone 7 px ahead.
const Maker clip = made([](int variant) {
  face::Image image{64, 48, 3, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double u = x - variant, v = y;
      const double grain = 9 * std::sin(1.9 * u + 0.7 * v) * std::cos(1.3 * v - 0.5 * u) +
                           14 * std::sin(0.63 * u - 0.2 * v) * std::sin(0.71 * v);
      double red = 170 + grain, green = 120 + grain, blue = 100 + grain;
      const double across = (u - 32) / 8, along = (v - 34) / (3 + 0.4 * variant);
      if (across * across + along * along < 1) red = 160, green = 60 + grain, blue = 70;
      if (std::abs(along) < 0.2 && std::abs(across) < 0.9) red = green = blue = 30;
      const double ahead = variant == 1 ? 7 : 0;
      if (std::hypot(u - 32 - ahead, v - 22) < 3) red = green = blue = 220 + 10 * std::sin(u);
      for (const double eye : {26.0, 38.0})
        if (std::hypot(u - eye, v - 14) < 2.5) red = green = blue = 50 + 20 * std::cos(2 * u + v);
      if (variant % 2 == 1 && std::hypot(x - 27, y - 14) < 7) red = 190, green = 150, blue = 130;
      for (const double value : {red, green, blue})
        image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)));
    }
  return image;
});
// On the outline of that mouth.
const Maker first_points = changed<face::Landmarks>(speaker_points, [](face::Landmarks& landmarks, int) {
  for (int i = 0; i < 12; ++i) {
    face::Landmark& point = landmarks.points[static_cast<std::size_t>(3 + i)];
    point.x_px = 32 - 8 * std::cos(M_PI * i / 6);
    point.y_px = 34 - 3 * std::sin(M_PI * i / 6);
  }
});

const Maker correction = made([](int variant) {
  return face::Landmarks{{{"lip_3", 33.0 + 0.5 * variant, 32.0 - 0.5 * variant, true}}};
});

// Four frames of which one is shown longer.
const Maker uneven_timeline = made([](int variant) {
  return face::Timeline{{0, 0.04, 0.08 + 0.02 * variant, 0.12 + 0.02 * variant}, 0.16 + 0.02 * variant};
});

const Registered track({
    .inputs =
        {
            {"track.stabilise.landmarks", speaker_points},
            {"track.stabilise.rest", speaker_points},
            {"track.find_rest.landmarks", speaker_points},
            {"track.klt.start", first_points},
            {"track.klt.frames", clip},
            {"track.klt.correction", correction},
            {"track.chain_flow.from_first", another("flow_field", 2)},
            {"track.report.landmarks", losing_points(speaker_points)},
            {"track.report.state", states},
            {"track.report.timeline", uneven_timeline},
        },
    .params = {{"track.face_flow.margin", 0.1}},
});

}  // namespace
}  // namespace conformance
