// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/sculptor.h"

#include <array>
#include <limits>
#include <string>

#include "nodes/phantom/lips.h"

namespace face::phantom {
namespace {

constexpr double kFree = std::numeric_limits<double>::quiet_NaN();
constexpr double kInvisible_mm = 0.004;

bool on_mouth(const SkinVertex& v) { return v.loop == SkinVertex::Loop::mouth; }

std::vector<double> jaw_field(const Head& head) {
  const std::vector<SkinVertex>& skin = head.skin.vertices;
  std::vector<double> fixed(skin.size(), kFree), lips(skin.size(), kFree);
  for (std::size_t v = 0; v < skin.size(); ++v) {
    const double azimuth = std::abs(skin[v].at.azimuth_deg), elevation = skin[v].at.elevation_deg;
    if (on_mouth(skin[v]) && skin[v].ring < kMouthOuterRing) {
      // Along the lips such that the open mouth is an oval.
      const int side = lip_side(skin[v].column);
      const double oval = 0.5 - 0.5 * side * std::pow(1 - square(lip_position(skin[v].column)), 0.45);
      if (skin[v].ring <= 1 && skin[v].ring > -8) fixed[v] = lips[v] = oval;
      if (skin[v].ring == kMouthDeepestRing) fixed[v] = lips[v] = side < 0 ? 0.6 : 0.2;
      continue;
    }
    if (azimuth < 48 && elevation < -34 - 0.05 * azimuth && elevation > -46) fixed[v] = 1;
    if (elevation > 4 || elevation < -64 || azimuth > 100) fixed[v] = lips[v] = 0;
    if (azimuth < 14 && elevation > -12 && elevation < 5) fixed[v] = 0;
  }
  // First from all that is known; then, smoothly, from the lips alone.
  std::vector<double> field = diffuse(head, fixed, {}, 900);
  return diffuse(head, lips, field, 30);
}

std::vector<double> lower_field(const Head& head) {
  const std::vector<SkinVertex>& skin = head.skin.vertices;
  std::vector<double> fixed(skin.size(), kFree);
  for (std::size_t v = 0; v < skin.size(); ++v) {
    if (on_mouth(skin[v]) && skin[v].ring < 4) {
      const int side = lip_side(skin[v].column);
      if (std::abs(lip_position(skin[v].column)) < 0.93 || skin[v].ring <= kLipContactRing)
        fixed[v] = side == 0 ? 0.5 : side > 0 ? 0 : 1;
      continue;
    }
    if (skin[v].at.elevation_deg > -5) fixed[v] = 0;
    if (skin[v].at.elevation_deg < -38) fixed[v] = 1;
  }
  return diffuse(head, fixed, {}, 300);
}

}  // namespace

std::vector<double> diffuse(const Head& head, const std::vector<double>& fixed, const std::vector<double>& start,
                            int passes) {
  std::vector<double> value(fixed.size()), next(fixed.size());
  for (std::size_t v = 0; v < fixed.size(); ++v)
    value[v] = !std::isnan(fixed[v]) ? fixed[v] : start.empty() ? 0 : start[v];
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t v = 0; v < fixed.size(); ++v) {
      next[v] = value[v];
      if (!std::isnan(fixed[v])) continue;
      double sum = 0;
      for (const std::uint32_t n : head.skin.neighbours[v]) sum += value[n];
      next[v] = sum / static_cast<double>(head.skin.neighbours[v].size());
    }
    for (std::size_t v = 0; v < fixed.size(); ++v) value[v] = 0.5 * (next[v] + next[head.mesh.mirror[v]]);
  }
  return value;
}

Fields measure_fields(const Head& head) {
  const std::vector<SkinVertex>& skin = head.skin.vertices;
  Fields fields;
  fields.jaw = jaw_field(head);
  fields.lower = lower_field(head);
  constexpr std::array<double, 7> kLining = {0, 0, 0, 0.12, 0.40, 0.72, 0.92};  // rings -11 to -5
  const double half_width = head.mesh.points_mm[head.skin.mouth(0, 0)].x;
  for (std::size_t v = 0; v < skin.size(); ++v) {
    const Vector3 point = head.mesh.points_mm[v];
    const bool inside = on_mouth(skin[v]) && skin[v].ring <= 0;
    double nearest = inside ? 0 : 1e9;
    if (!inside)
      for (int c = 0; c < kMouthColumns; ++c)
        nearest = std::min(nearest, length(point - head.mesh.points_mm[head.skin.mouth(0, c)]));
    fields.lip_mm.push_back(nearest);
    fields.lining.push_back(inside && skin[v].ring < kLipContactRing
                                ? kLining[static_cast<std::size_t>(skin[v].ring - kMouthDeepestRing)]
                                : 1);
    fields.across.push_back(inside ? lip_position(skin[v].column) : point.x / half_width);
  }
  return fields;
}

Shape to_shape(const Head& head, std::string_view name, Offsets offsets) {
  for (const Attached* attached : {&head.lashes, &head.brows})
    for (std::uint32_t v = attached->range.first; v < attached->range.end; ++v)
      for (const Anchor& anchor : attached->anchors[v - attached->range.first])
        offsets[v] += anchor.weight * offsets[anchor.vertex];
  Shape shape;
  shape.name = std::string(name);
  for (std::uint32_t v = 0; v < offsets.size(); ++v) {
    if (length(offsets[v]) < kInvisible_mm) continue;
    shape.vertices.push_back(v);
    shape.offsets_mm.push_back(to_float(offsets[v]));
  }
  return shape;
}

Offsets mirror_image(const Head& head, const Offsets& offsets) {
  Offsets other(offsets.size());
  for (std::size_t v = 0; v < offsets.size(); ++v) other[head.mesh.mirror[v]] = mirrored(offsets[v]);
  return other;
}

void symmetrise(const Head& head, Offsets& offsets) {
  const Offsets other = mirror_image(head, offsets);
  for (std::size_t v = 0; v < offsets.size(); ++v) offsets[v] = 0.5 * (offsets[v] + other[v]);
}

}  // namespace face::phantom
