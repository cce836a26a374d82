// SPDX-License-Identifier: Apache-2.0
// Jaw, tongue and cheeks of the embedded head.
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/phantom/sculptor.h"

namespace face::phantom {
namespace {

constexpr Vector3 kJawHinge = {0, 14, 8};  // both joints, projected on the middle plane, mm
constexpr double kJawOpenDeg = 20.5;

// Moves what rides on the jaw: `turn` gives a point's new place for a share of the full motion.
template <class Turn>
Offsets move_jaw(const Head& head, const Fields& fields, Turn turn) {
  Offsets offsets(head.mesh.points_mm.size());
  const auto move = [&](std::uint32_t v, double share) {
    offsets[v] = turn(head.mesh.points_mm[v], share) - head.mesh.points_mm[v];
  };
  for (std::uint32_t v = 0; v < fields.jaw.size(); ++v) move(v, fields.jaw[v]);
  for (const VertexRange& range : {head.mouth.lower_teeth, head.mouth.lower_gums})
    for (std::uint32_t v = range.first; v < range.end; ++v) move(v, 1);
  for (std::uint32_t v = head.mouth.tongue.first; v < head.mouth.tongue.end; ++v)
    move(v, lerp(0.8, 1.0, smooth_step(0, 0.6, tongue_position(v - head.mouth.tongue.first))));
  return offsets;
}

// The tongue slides forward over the lower teeth and lip, then its tip hangs down. It fits an open jaw (jawOpen >=
// 0.4).
Offsets tongue_out(const Head& head) {
  Offsets offsets(head.mesh.points_mm.size());
  for (std::uint32_t v = head.mouth.tongue.first; v < head.mouth.tongue.end; ++v) {
    const double t = tongue_position(v - head.mouth.tongue.first);
    const double z = lerp(54.0, 137.0, t);
    const double y = lerp(-48.0, -31.0, smooth_step(58, 98, z)) - 7.0 * smooth_step(112, 140, z);
    const double old_z = lerp(54.0, 97.5, t), old_y = lerp(-48.0, -43.5, smooth_step(0, 0.7, t)) + 1.2 * t * t;
    const Vector3 point = head.mesh.points_mm[v];
    const double flat = -0.25 * smooth_step(0.3, 0.6, t);
    offsets[v] = {0.12 * point.x * smooth_step(0.4, 0.8, t), y - old_y + flat * (point.y - old_y), z - old_z};
  }
  return offsets;
}

// Moves the skin about a place, by its distance in mm.
void push(const Head& head, const Fields& fields, Vector3 centre, double radius_mm, Vector3 by, Offsets& offsets) {
  for (std::size_t v = 0; v < fields.jaw.size(); ++v) {
    const SkinVertex& vertex = head.skin.vertices[v];
    double weight = std::exp(-square(length(head.mesh.points_mm[v] - centre) / radius_mm));
    if (vertex.loop == SkinVertex::Loop::mouth)
      weight *= smooth_step(0, 10, fields.lip_mm[v]);
    else if (vertex.loop != SkinVertex::Loop::none)
      weight *= smooth_step(1, 6, vertex.ring);
    if (weight > 0.01) offsets[v] += smooth_step(0.01, 0.08, weight) * weight * by;
  }
}

}  // namespace

Offsets jaw_shape(const Head& head, const Fields& fields, std::string_view name) {
  if (name == "tongueOut") return tongue_out(head);
  if (name == "jawForward")
    return move_jaw(head, fields, [](Vector3 p, double share) { return p + share * Vector3{0, -0.3, 6.5}; });
  if (name == "jawLeft") {
    // The lips stay shut: both go half of the way.
    Fields sealed = fields;
    for (std::size_t v = 0; v < sealed.jaw.size(); ++v) {
      const double near = std::max(bell(fields.lip_mm[v], 9), 0.0);
      sealed.jaw[v] = lerp(fields.jaw[v], 0.5 * smooth_step(60, 20, fields.lip_mm[v]), near);
    }
    return move_jaw(head, sealed, [](Vector3 p, double share) { return p + share * Vector3{7.0, -0.2, -0.02 * p.x}; });
  }
  check(name == "jawOpen", "'", name, "' is not a shape of the jaw");
  Offsets offsets = move_jaw(head, fields, [](Vector3 p, double share) {
    const double a = share * kJawOpenDeg * std::numbers::pi / 180;
    const Vector3 d = p - kJawHinge;
    return kJawHinge + Vector3{d.x, d.y * std::cos(a) - d.z * std::sin(a), d.z * std::cos(a) + d.y * std::sin(a)};
  });
  // An open mouth is narrower: its corners come in.
  for (std::size_t v = 0; v < fields.jaw.size(); ++v) {
    const double corner =
        smooth_step(0.3, 1, std::abs(fields.across[v])) * bell(fields.lip_mm[v], 14) * fields.lining[v];
    offsets[v].x -= 0.10 * head.mesh.points_mm[v].x * corner;
  }
  symmetrise(head, offsets);
  return offsets;
}

Offsets cheek_shape(const Head& head, const Fields& fields, std::string_view name) {
  Offsets offsets(head.mesh.points_mm.size());
  if (name == "cheekPuff") {
    for (const double side : {1.0, -1.0}) {
      push(head, fields, {side * 47, -24, 80}, 26, {side * 7.5, 0, 6.0}, offsets);
      push(head, fields, {side * 20, -18, 112}, 14, {side * 0.5, 0.5, 2.2}, offsets);
      push(head, fields, {side * 18, -52, 104}, 14, {side * 0.5, -0.5, 2.2}, offsets);
    }
    // The lips are pushed out, still shut.
    for (std::size_t v = 0; v < fields.jaw.size(); ++v)
      offsets[v].z += 3.4 * bell(fields.lip_mm[v], 16) * fields.lining[v] * smooth_step(58, 30, fields.lip_mm[v]);
    symmetrise(head, offsets);
  } else if (name == "cheekSquintLeft") {
    push(head, fields, {38, 3, 92}, 19, {1.0, 6.0, 2.4}, offsets);
  } else if (name == "noseSneerLeft") {
    push(head, fields, {13, -3, 113}, 9, {1.0, 5.0, 0.2}, offsets);
    push(head, fields, {20, -10, 108}, 11, {0.6, 4.0, 1.4}, offsets);
    push(head, fields, {9, 22, 110}, 8, {-0.4, 2.4, 1.2}, offsets);
    push(head, fields, {12, 48, 108}, 9, {-0.8, -2.2, 0.8}, offsets);
  } else {
    fail("'", name, "' is not a shape of the left cheek");
  }
  return offsets;
}

}  // namespace face::phantom
