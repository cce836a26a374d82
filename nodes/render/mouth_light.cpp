// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/mouth_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

namespace face::render {
namespace {

struct Opening {
  Vec3f centre_mm = {0, 0, 0};
  float area_mm2 = 0;
};

bool is_in_mouth(const std::string& part) {
  constexpr std::array<std::string_view, 4> words = {"mouth", "gum", "tongue", "teeth"};
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return part.find(word) != std::string::npos; });
}

Vec3f mean_of(const std::vector<Vec3f>& points) {
  Vec3f sum = {0, 0, 0};
  for (const Vec3f& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += p[axis] / static_cast<float>(points.size());
  return sum;
}

// Area of the frontal projection; lips that overlap give nothing.
float front_area(const std::vector<Vec3f>& outline) {
  float twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3f &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5f * std::abs(twice);
}

// Lips have depth: a narrow slit between them lets little light through.
float through_lips(float area_mm2, float width_mm) {
  constexpr float depth_mm = 4;
  const float height_mm = area_mm2 / std::max(width_mm, 1.0f);
  return area_mm2 * height_mm / (height_mm + depth_mm);
}

Opening opening_of(const Rig& rig, const std::vector<Vec3f>& points, const Vec3f& front_of_mouth) {
  std::vector<Vec3f> outline, closed;
  float low = 1e9f, high = -1e9f;
  const auto add = [&](std::uint32_t vertex) {
    outline.push_back(points[vertex]);
    closed.push_back(rig.neutral.points_mm[vertex]);
    low = std::min(low, points[vertex][0]);
    high = std::max(high, points[vertex][0]);
  };
  if (rig.landmarks68.size() == 68) {
    for (std::size_t i = 60; i < 68; ++i) add(rig.landmarks68[i]);
    // The marks stand beside the line where the lips meet: what they enclose in the neutral is no opening.
    return {mean_of(outline), through_lips(std::max(0.0f, front_area(outline) - front_area(closed)), high - low)};
  }
  if (!rig.inner_lips.empty()) {
    float height = 0;
    for (const LipPair& pair : rig.inner_lips) {
      add(pair.upper);
      add(pair.lower);
      const float gap = points[pair.upper][1] - points[pair.lower][1];
      const float closed_gap = rig.neutral.points_mm[pair.upper][1] - rig.neutral.points_mm[pair.lower][1];
      height += std::max(0.0f, gap - closed_gap) / static_cast<float>(rig.inner_lips.size());
    }
    const float width = std::max(high - low, 30.0f);  // the pairs are about the middle only
    return {mean_of(outline), through_lips(height * width, width)};
  }
  return {front_of_mouth, 35.0f * 20.0f};
}

Vec3f bounced_light(float area_mm2) {
  constexpr float walls_mm2 = 21500;
  constexpr Vec3f reflectance = {0.46f, 0.17f, 0.14f};  // of wet, red tissue
  constexpr Vec3f through_cheeks = {0.060f, 0.013f, 0.010f};
  constexpr float gain = 3.5f;  // the eye adapts
  Vec3f light;
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = through_cheeks[c] + gain * area_mm2 / walls_mm2 * reflectance[c] / (1 - reflectance[c]);
  return light;
}

}  // namespace

MouthLight mouth_light(const Rig& rig, const std::vector<Vec3f>& points_mm, float gain) {
  constexpr float darkest = 0.015f;
  constexpr float out_mm = 3;  // so far before the opening it is as light as outside
  MouthLight light;
  light.exposure.assign(points_mm.size(), 1.0f);
  light.inside.assign(points_mm.size(), false);
  bool any = false;
  Vec3f front = {0, 0, -1e9f};
  const Mesh& mesh = rig.neutral;
  for (const Part& part : mesh.parts) {
    if (!part.visible || !is_in_mouth(part.name)) continue;
    any = true;
    const std::uint32_t end = mesh.polygon_starts[part.first_polygon + part.polygon_count];
    for (std::uint32_t c = mesh.polygon_starts[part.first_polygon]; c < end; ++c) {
      const std::uint32_t v = mesh.corners[c];
      light.inside[v] = true;
      if (points_mm[v][2] > front[2]) front = points_mm[v];
    }
  }
  if (!any) return light;
  const Opening opening = opening_of(rig, points_mm, front);
  light.opening_mm = opening.centre_mm;
  light.bounced = bounced_light(opening.area_mm2);
  for (std::size_t v = 0; v < points_mm.size(); ++v) {
    if (!light.inside[v]) continue;
    const Vec3f& p = points_mm[v];
    const float dx = p[0] - opening.centre_mm[0], dy = p[1] - opening.centre_mm[1];
    // Beside the opening counts half: the lips are no tube, light comes from the sides as well.
    const float dz = p[2] - opening.centre_mm[2];
    const float squared = 0.25f * (dx * dx + dy * dy) + dz * dz;
    const float share = opening.area_mm2 / (opening.area_mm2 + std::numbers::pi_v<float> * squared);
    const float in_front = std::min(dz / out_mm, 1.0f);  // a tongue that is out
    light.exposure[v] = std::clamp(std::max(gain * share, in_front), darkest, 1.0f);
  }
  return light;
}

}  // namespace face::render
