// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/samples/shared.h"

#include <algorithm>
#include <cmath>

#include "nodes/types/arkit.h"
#include "nodes/types/camera.h"
#include "nodes/types/image.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

template <class T>
T sample(const std::string& type, int variant) {
  return *static_cast<const T*>(test::sample(type, variant).get());
}

face::Landmarks seen_points(int variant) {
  const auto rig = sample<face::Rig>("rig", variant);
  const auto camera = sample<face::Camera>("camera", variant);
  face::Landmarks landmarks;
  for (std::size_t i = 0; i < rig.landmarks68.size(); ++i) {
    face::Vec3f p = rig.neutral.points_mm[rig.landmarks68[i]];
    for (std::size_t k = 0; k < 3; ++k) p[k] -= camera.position_mm[k];
    const double scale = static_cast<double>(camera.focal_px) / -static_cast<double>(p[2]);
    const double waver = 0.15 * std::sin(2.3 * static_cast<double>(i));  // of the person who placed them
    landmarks.points.push_back({std::to_string(i), camera.centre_x_px + scale * static_cast<double>(p[0]) + waver,
                                camera.centre_y_px - scale * static_cast<double>(p[1]), true});
  }
  return landmarks;
}

face::Landmarks named_points(int variant) {
  face::Landmarks landmarks{{{"eye_inner_r", 26, 14, true}, {"eye_inner_l", 38, 14, true}, {"nose_tip", 32, 22, true}}};
  for (int i = 0; i < 12; ++i)
    landmarks.points.push_back({"lip_" + std::to_string(i), 32 - 8 * std::cos(M_PI * i / 6),
                                32 - (3 + 0.4 * variant) * std::sin(M_PI * i / 6), true});
  for (face::Landmark& point : landmarks.points) point.y_px += 0.05 * variant * (point.x_px - 20);
  return landmarks;
}

}  // namespace

Sample face_points(engine::Plugins&, int variant) { return held(seen_points(variant)); }

Sample two_digit_points(engine::Plugins&, int variant) {
  face::Landmarks landmarks = seen_points(variant);
  for (face::Landmark& point : landmarks.points)
    if (point.name.size() == 1) point.name = "0" + point.name;
  return held(landmarks);
}

Sample speaker_points(engine::Plugins&, int variant) { return held(named_points(variant)); }

Sample speaker_keys(engine::Plugins&, int variant) {
  face::KeyShapes keys;
  for (int k = 0; k < 4; ++k) {
    keys.shapes.push_back({std::to_string(k), 4 + k, named_points(3 * k + variant)});
    if (variant == 3) keys.shapes.back().landmarks.points.pop_back();
  }
  return held(keys);
}

Sample grey_picture(engine::Plugins&, int variant) {
  const auto picture = sample<face::Image>("image", variant);
  face::Image grey{picture.width, picture.height, 1, {}};
  for (std::size_t i = 0; i < picture.pixels.size(); i += static_cast<std::size_t>(picture.channels))
    grey.pixels.push_back(picture.pixels[i]);
  return held(grey);
}

Sample disc(engine::Plugins&, int variant) {
  face::Image mask{64, 48, 1, {}};
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      mask.pixels.push_back(std::hypot(x - 32 - variant, y - 26) < 6 + 2 * (variant % 4) ? 255 : 0);
  return held(mask);
}

Sample sized_picture(engine::Plugins&, int variant) {
  auto picture = sample<face::Image>("image", variant);
  picture.height -= variant;
  picture.pixels.resize(static_cast<std::size_t>(picture.width * picture.height * picture.channels));
  return held(picture);
}

Sample few_weights(engine::Plugins&, int variant) {
  const float more = 0.1f * static_cast<float>(variant);
  return held(face::Weights{{0.1f + more, 0.3f - more, 0.2f + more, 0.1f}});
}

Sample opening_mouth(engine::Plugins&, int variant) {
  face::Weights weights;
  weights.values.assign(face::arkit_count, 0.05f);
  weights.values[face::arkit_index("jawOpen")] = 0.3f * static_cast<float>(variant % 4);
  return held(weights);
}

Sample spread_timeline(engine::Plugins&, int variant) {
  const double step = 0.25 + 0.02 * variant;
  face::Timeline timeline;
  for (int f = 0; f < 4; ++f) timeline.time_s.push_back(step * f);
  timeline.duration_s = 4 * step;
  return held(timeline);
}

Maker scattered(Maker maker, double most_px) {
  return changed<face::Landmarks>(maker, [most_px](face::Landmarks& landmarks, int variant) {
    for (std::size_t i = 0; i < landmarks.points.size(); ++i) {
      const double angle = 2.4 * static_cast<double>(i) + variant, way = most_px * static_cast<double>(i % 6) / 5;
      landmarks.points[i].x_px += way * std::cos(angle);
      landmarks.points[i].y_px += way * std::sin(angle);
    }
  });
}

Maker losing_points(Maker maker) {
  return changed<face::Landmarks>(maker, [](face::Landmarks& landmarks, int variant) {
    const std::size_t lost = static_cast<std::size_t>(variant + 1) % 4;
    for (std::size_t i = 0; i < std::min(lost, landmarks.points.size()); ++i) landmarks.points[i].valid = false;
  });
}

}  // namespace conformance
