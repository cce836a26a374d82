// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_head.h"

#include <array>
#include <limits>
#include <string>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/phantom/lips.h"
#include "nodes/phantom/neutral_head.h"
#include "nodes/phantom/sculptor.h"
#include "nodes/types/arkit.h"

namespace face::phantom {
namespace {

Offsets sculpt(const Head& head, const Fields& fields, std::string_view name) {
  if (name.starts_with("eye")) return eye_shape(head, name);
  if (name.starts_with("brow")) return brow_shape(head, name);
  if (name.starts_with("jaw") || name == "tongueOut") return jaw_shape(head, fields, name);
  if (name.starts_with("mouth")) return mouth_shape(head, fields, name);
  return cheek_shape(head, fields, name);
}

// Shapes of the right are the mirror images of those of the left.
Shape make_shape(const Head& head, const Fields& fields, std::string_view name) {
  const std::size_t right = name.find("Right");
  if (right == std::string_view::npos) return to_shape(head, name, sculpt(head, fields, name));
  const std::string left = std::string(name.substr(0, right)) + "Left";
  return to_shape(head, name, mirror_image(head, sculpt(head, fields, left)));
}

// The skin's vertex nearest to a place of the chart, on the face's outside.
std::uint32_t nearest_vertex(const Head& head, ChartPoint at) {
  std::uint32_t best = 0;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = 0; v < head.skin.vertices.size(); ++v) {
    const SkinVertex& vertex = head.skin.vertices[v];
    if (vertex.loop != SkinVertex::Loop::none && vertex.ring < 0) continue;
    const double distance =
        square(vertex.at.azimuth_deg - at.azimuth_deg) + square(vertex.at.elevation_deg - at.elevation_deg);
    if (distance < best_distance) {
      best = v;
      best_distance = distance;
    }
  }
  return best;
}

// Jaw line, brows and nose in the chart, on the right half and the middle, in Multi-PIE order.
constexpr std::array<ChartPoint, 9> kJawLine = {
    {{-74, 26}, {-71, 11}, {-66, -4}, {-60, -18}, {-50, -30}, {-36, -38}, {-23, -39.5}, {-11, -39.5}, {0, -39.5}}};
constexpr std::array<ChartPoint, 5> kBrow = {{{-34, 31}, {-28, 33.5}, {-21, 34}, {-14, 33}, {-8, 31}}};
constexpr std::array<ChartPoint, 4> kNoseRidge = {{{0, 20}, {0, 14}, {0, 8}, {0, 2}}};
constexpr std::array<ChartPoint, 3> kNoseFoot = {{{-7, -5.5}, {-3.5, -6}, {0, -6.5}}};

std::vector<std::uint32_t> find_landmarks(const Head& head) {
  std::vector<std::uint32_t> marks;
  const auto add_with_mirror = [&](const auto& right_half, bool has_middle) {
    for (const ChartPoint& at : right_half) marks.push_back(nearest_vertex(head, at));
    const std::size_t first = marks.size() - right_half.size();
    for (std::size_t k = right_half.size() - (has_middle ? 1 : 0); k > 0; --k)
      marks.push_back(head.mesh.mirror[marks[first + k - 1]]);
  };
  add_with_mirror(kJawLine, true);
  add_with_mirror(kBrow, false);
  for (const ChartPoint& at : kNoseRidge) marks.push_back(nearest_vertex(head, at));
  add_with_mirror(kNoseFoot, true);
  for (const int column : {0, 9, 17, 26, 35, 43}) marks.push_back(head.skin.right_eye(-1, column));
  for (const int column : {26, 17, 9, 0, 43, 35}) marks.push_back(head.skin.left_eye(-1, column));
  for (const int column : {36, 29, 22, 18, 14, 7, 0, 65, 59, 54, 49, 43}) marks.push_back(head.skin.mouth(0, column));
  for (const int column : {36, 25, 18, 11, 0, 61, 54, 47}) marks.push_back(head.skin.mouth(kLipContactRing, column));
  return marks;
}

}  // namespace

Rig make_head(const MakeHeadOptions& options) {
  const Head head = neutral_head(options);
  const Fields fields = measure_fields(head);
  Rig rig;
  rig.neutral = head.mesh.to_mesh();
  for (const std::string_view name : arkit_names) rig.shapes.push_back(make_shape(head, fields, name));
  for (const int column : {12, 15, 18, 21, 24})
    rig.inner_lips.push_back(
        {head.skin.mouth(kLipContactRing, column), head.skin.mouth(kLipContactRing, kMouthColumns - column)});
  for (int ring = kLipContactRing - 1; ring <= kLipContactRing + 1; ++ring)
    for (int column = 37; column < kMouthColumns; ++column)
      if (std::abs(lip_position(column)) < 0.5) rig.lower_lip.push_back(head.skin.mouth(ring, column));
  rig.upper_teeth = head.mouth.upper_front_teeth;
  rig.landmarks68 = find_landmarks(head);
  return rig;
}

}  // namespace face::phantom
