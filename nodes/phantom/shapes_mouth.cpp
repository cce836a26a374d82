// SPDX-License-Identifier: Apache-2.0
// Lips of the embedded head. Where a shape keeps the mouth shut, the line along which the lips touch moves as a
// function of the place across the mouth only, the same for both lips, so that no combination of such shapes opens or
// crosses them.
#include "nodes/base/check.h"
#include "nodes/phantom/lips.h"
#include "nodes/phantom/sculptor.h"

namespace face::phantom {
namespace {

// One vertex of the skin as the lip shapes see it.
struct LipView {
  double x;        // mm
  double across;   // 1 left corner, -1 right corner
  double outside;  // mm from the lips' red
  double lower;    // 0 upper lip, 1 lower lip
  double red;      // 0 on the line where the lips touch, 1 at the border of the red and beyond
  double jaw;
  double thin;  // 1 in the middle, 0 at the corners and beyond
  double y;     // mm
  int ring;     // 99 off the mouth's loops
};

double left_half(double across) { return smooth_step(-0.25, 0.25, across); }

// The corner of the mouth on the left, along the lips and around it on the cheek.
double corner_weight(const LipView& at, double reach_mm) {
  return square(std::clamp((at.across + 0.3) / 1.3, 0.0, 1.0)) * bell(at.outside, reach_mm);
}

Vector3 roll(const LipView& at, double up, double back_mm, double lining_follows) {
  // The red turns in over the teeth: its border comes to where the lips touch, the rest goes back.
  const double full = std::pow(std::max(at.thin, 0.0), 0.6), near = bell(at.outside, 9);
  const double in_red = at.ring <= 0 ? 1 : near;
  return {0, up * in_red * full * (at.ring <= 0 ? 4.2 * at.red : 4.2 * near),
          -in_red * full * (back_mm - 1.2 * at.red) * (at.ring < kLipContactRing ? lining_follows : 1)};
}

Vector3 lip_offset(std::string_view name, const LipView& at) {
  const double upper = 1 - at.lower, away = upper - at.lower;  // away: up on the upper lip, down on the lower one
  const double near = bell(at.outside, 15), wide = bell(at.outside, 24);
  const double middle = std::max(0.0, at.thin);
  if (name == "mouthFunnel")
    return {-0.20 * at.x * wide, (5.0 * upper - 7.4 * at.lower) * near * std::pow(middle, 0.7),
            near * (3.5 + 4.0 * middle)};
  if (name == "mouthPucker") return {-0.30 * at.x * wide, away * near * at.red * middle, near * (5.0 + 4.0 * middle)};
  if (name == "mouthLeft") return {8.5 * wide, 0.5 * at.across * wide, -0.10 * at.x * wide};
  if (name == "mouthSmileLeft") {
    const double w = corner_weight(at, 17);
    // The cheek rounds up above a fold that runs from the nose past the corner.
    const double cheek = bell(at.x - 38, 15) * bell(at.y + 8, 13), fold = bell(at.x - 31, 4.5) * bell(at.y + 22, 10);
    return Vector3{6.4 * w, 8.4 * w - 0.8 * away * at.red * w, -5.2 * w * smooth_step(0, 1, at.across)} +
           smooth_step(1, 8, at.outside) * (cheek * Vector3{1.0, 2.4, 2.6} + fold * Vector3{0.0, 0.0, -1.4});
  }
  if (name == "mouthFrownLeft") {
    const double w = corner_weight(at, 15);
    return {0.8 * w, -7.0 * w, -0.8 * w};
  }
  if (name == "mouthDimpleLeft") {
    const double w = corner_weight(at, 12);
    return {4.0 * w, 0.8 * w, -4.0 * w};
  }
  if (name == "mouthStretchLeft") {
    const double w = corner_weight(at, 16);
    return {7.0 * w, -3.2 * w - 0.7 * away * at.red * w, -4.0 * w};
  }
  if (name == "mouthRollLower") return at.lower * roll(at, 1, 5.0, 1);
  if (name == "mouthRollUpper") return upper * roll(at, -1, 4.4, 0.6);
  if (name == "mouthShrugLower") {
    // The chin's muscle pushes both lips up and out, still shut.
    const double lips = std::pow(middle, 0.7) * near * (at.lower + upper * bell(at.outside, 7));
    const double chin = at.lower * middle * bell(at.outside - 17, 11);
    return {0, 2.4 * lips + 3.2 * chin, near * middle * 2.4 + 2.0 * chin};
  }
  if (name == "mouthShrugUpper") return {0, 3.4 * upper * near * std::pow(middle, 0.7), 2.0 * upper * near * middle};
  if (name == "mouthPressLeft") {
    const double w = left_half(at.across) * bell(at.outside, 8);
    const double corner = corner_weight(at, 10);
    return {0.5 * corner, -1.9 * away * w * at.red * std::pow(middle, 0.5),
            -(1.2 + 0.8 * at.red) * w * std::pow(middle, 0.5) - 1.4 * corner};
  }
  if (name == "mouthLowerDownLeft") {
    const double w = left_half(at.across) * at.lower * std::pow(middle, 0.6) * bell(at.outside, 16);
    return {0.8 * w, -6.5 * w, -0.8 * w};
  }
  if (name == "mouthUpperUpLeft") {
    const double w = left_half(at.across) * upper * std::pow(middle, 0.6) * bell(at.outside, 15);
    return {0.4 * w, 7.0 * w, 0.2 * w};
  }
  fail("'", name, "' is not a shape of the mouth");
}

// Undoes jawOpen at the lips: they meet between where the upper lip is and where the jaw has taken the lower one.
Offsets close_mouth(const Head& head, const Fields& fields) {
  const Offsets open = jaw_shape(head, fields, "jawOpen");
  Offsets offsets(head.mesh.points_mm.size());
  // The upper lip comes down, but hardly back: the upper teeth are behind it.
  constexpr double kUpperShare = 0.30, kUpperBackShare = 0.12;
  for (std::size_t v = 0; v < fields.jaw.size(); ++v) {
    const SkinVertex& vertex = head.skin.vertices[v];
    if (vertex.loop != SkinVertex::Loop::mouth) continue;
    const int side = lip_side(vertex.column);
    if (side == 0) continue;
    const int partner = kMouthColumns - vertex.column;
    const std::uint32_t here = head.skin.mouth(kLipContactRing, vertex.column);
    const std::uint32_t there = head.skin.mouth(kLipContactRing, partner);
    const Vector3 gap = open[side > 0 ? there : here] - open[side > 0 ? here : there];  // lower minus upper lip
    const double fade = vertex.ring > 0 ? smooth_step(kMouthOuterRing, 0, vertex.ring) : fields.lining[v];
    const Vector3 upper = {kUpperShare * gap.x, kUpperShare * gap.y, kUpperBackShare * gap.z};
    offsets[v] = fade * (side > 0 ? upper : upper - gap);
  }
  symmetrise(head, offsets);
  return offsets;
}

}  // namespace

Offsets mouth_shape(const Head& head, const Fields& fields, std::string_view name) {
  if (name == "mouthClose") return close_mouth(head, fields);
  Offsets offsets(head.mesh.points_mm.size());
  for (std::size_t v = 0; v < fields.jaw.size(); ++v) {
    if (fields.lip_mm[v] > 60 || fields.lining[v] == 0) continue;
    const SkinVertex& vertex = head.skin.vertices[v];
    if (vertex.loop == SkinVertex::Loop::left_eye || vertex.loop == SkinVertex::Loop::right_eye) continue;
    LipView at;
    at.x = head.mesh.points_mm[v].x;
    at.y = head.mesh.points_mm[v].y;
    at.across = std::clamp(fields.across[v], -1.6, 1.6);
    at.outside = fields.lip_mm[v];
    at.lower = fields.lower[v];
    at.jaw = fields.jaw[v];
    at.ring = vertex.loop == SkinVertex::Loop::mouth ? vertex.ring : 99;
    at.red = at.ring >= 0 ? 1 : at.ring <= kLipContactRing ? 0 : 1 + at.ring / 4.0;
    at.thin = 1 - square(at.across);
    const double fade = smooth_step(58, 30, fields.lip_mm[v]);
    offsets[v] = fade * fields.lining[v] * lip_offset(name, at);
  }
  return offsets;
}

}  // namespace face::phantom
