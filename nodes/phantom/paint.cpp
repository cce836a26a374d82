// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/paint.h"

#include "nodes/phantom/eyelids.h"
#include "nodes/phantom/lips.h"

namespace face::phantom {
namespace {

constexpr Vector3 kSkin = {0.93, 0.735, 0.635};
constexpr Vector3 kBlush = {0.90, 0.57, 0.49};
constexpr Vector3 kLip = {0.78, 0.42, 0.40}, kLipInner = {0.62, 0.27, 0.27};
constexpr Vector3 kLidShade = {0.80, 0.58, 0.51}, kLidRim = {0.86, 0.60, 0.55}, kLashRoot = {0.24, 0.14, 0.12};
constexpr Vector3 kMouth = {0.42, 0.13, 0.13}, kThroat = {0.13, 0.03, 0.03};

Vector3 skin_color(const SkinVertex& v, Vector3 point) {
  using Loop = SkinVertex::Loop;
  const double x = std::abs(point.x), y = point.y;
  Vector3 color = kSkin;
  if (point.z > 30) {
    color = lerp(color, kBlush, 0.40 * bell(x - 43, 19) * bell(y + 2, 17));  // cheeks
    color = lerp(color, kBlush, 0.32 * bell(x, 15) * bell(y - 2, 11));       // nose
    color = lerp(color, kBlush, 0.22 * bell(x, 16) * bell(y + 66, 10));      // chin
    color = lerp(color, {0.28, 0.10, 0.08}, 0.85 * nostril_darkness(v.at));
  }
  if (v.loop == Loop::left_eye || v.loop == Loop::right_eye) {
    color = lerp(color, kLidShade, 0.38 * smooth_step(5.5, 1.5, v.ring));
    if (v.ring <= 0) color = kLidRim;
    if (v.ring <= 0 && lid_side(v.column) > 0)
      color = lerp(color, kLashRoot, 0.8 * smooth_step(-1.0, 0.0, lid_position(v.column)));
  }
  if (v.loop == Loop::mouth) {
    const double s = lip_position(v.column);
    if (v.ring > 0) color = lerp(color, kLip, 0.30 * smooth_step(1.6, 0.4, v.ring));
    if (v.ring == 0) color = lerp(kSkin, kLip, 0.55 - 0.25 * s * s);
    if (v.ring < 0) color = lerp(kLip, kLipInner, smooth_step(-1.5, kLipContactRing, v.ring));
    if (v.ring < kLipContactRing) color = lerp(kLipInner, kMouth, smooth_step(-4, -7, v.ring));
    if (v.ring < -7) color = lerp(kMouth, kThroat, smooth_step(-7, -10, v.ring));
  }
  return color;
}

}  // namespace

void paint_skin(HeadBuilder& mesh, const Skin& skin) {
  for (std::size_t v = 0; v < skin.vertices.size(); ++v)
    mesh.colors_srgb[v] = skin_color(skin.vertices[v], mesh.points_mm[v]);
}

}  // namespace face::phantom
