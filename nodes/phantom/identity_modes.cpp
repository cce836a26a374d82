// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/identity_modes.h"

#include <numbers>
#include <vector>

#include "nodes/phantom/eyelids.h"
#include "nodes/phantom/identity_table.h"
#include "nodes/phantom/lips.h"
#include "nodes/phantom/neutral_head.h"

namespace face::phantom {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr Vector3 kEarRoot = {70, 11, 6};  // where the left ear grows out of the head

double weight_at(const Push& push, Vector3 p) {
  return std::exp(-square((p.x - push.at.x) / push.radius.x) - square((p.y - push.at.y) / push.radius.y) -
                  square((p.z - push.at.z) / push.radius.z));
}

Push mirrored(const Push& push) { return {phantom::mirrored(push.at), push.radius, phantom::mirrored(push.by)}; }

Vector3 pushed(const IdentityMode& mode, Vector3 p) {
  Vector3 sum;
  for (const Push& push : mode.pushes) {
    sum += weight_at(push, p) * push.by;
    // A push in the middle plane is its own mirror image.
    if (mode.side == Side::single || push.at.x == 0) continue;
    const Push other = mirrored(push);
    sum += (mode.side == Side::both ? 1.0 : -1.0) * weight_at(other, p) * other.by;
  }
  return sum;
}

// Rotation about z, positive turns x to y.
Vector3 turned_z(Vector3 d, double angle) {
  return {d.x * std::cos(angle) - d.y * std::sin(angle), d.x * std::sin(angle) + d.y * std::cos(angle), d.z};
}

// Of the lips alone: height of the red and the notch in its middle. Nothing moves where the lips touch.
Vector3 lip_feature(const Feature& feature, const Fields& fields, const SkinVertex& vertex, std::uint32_t v) {
  if (vertex.loop != SkinVertex::Loop::mouth || vertex.ring < kLipContactRing) return {};
  const double s = lip_position(vertex.column), thin = 1 - s * s;
  const int side = lip_side(vertex.column);
  const double red = vertex.ring >= 0 ? 1 : 1 + vertex.ring / 4.0, near = bell(fields.lip_mm[v], 5.5);
  const double height = side > 0 ? feature.upper_lip_mm : side < 0 ? feature.lower_lip_mm : 0;
  Vector3 by = height * std::pow(thin, 0.8) * near * Vector3{0, side * red, 2.4 * red * (1 - red) + 0.35 * red};
  if (side > 0) by.y += feature.cupid_bow_mm * thin * red * near * (bell(std::abs(s) - 0.25, 0.13) - bell(s, 0.12));
  return by;
}

// Of an eye: what its lids and its ball do, for a point near the left one.
Vector3 eye_feature(const Feature& feature, Vector3 p) {
  const Vector3 d = p - kEyeCentre;
  return (1 + feature.eye_scale) * turned_z(d, feature.eye_tilt_deg * kDegree) - d;
}

// The upper lid's edge goes up along the ball, and the rings above it less and less.
Vector3 lid_feature(const Feature& feature, const SkinVertex& vertex, Vector3 p) {
  if (feature.upper_lid_mm == 0 || lid_side(vertex.column) <= 0) return {};
  const double s = lid_position(vertex.column);
  const double up = feature.upper_lid_mm * std::pow(std::max(0.0, 1 - s * s), 0.8) * smooth_step(5, 0, vertex.ring);
  const Vector3 d = p - kEyeCentre, to = {d.x, d.y + up, d.z};
  return to * (length(d) / length(to)) - d;
}

Vector3 ear_feature(const Feature& feature, Vector3 p) {
  Vector3 d = p - kEarRoot;
  const Vector3 from = d;
  const double stand = feature.ear_stand_deg * kDegree, tilt = feature.ear_tilt_deg * kDegree;
  // Stands off about its front edge; tilts in its plane.
  const Vector3 e = {d.x * std::cos(stand) - d.z * std::sin(stand), d.y, d.z * std::cos(stand) + d.x * std::sin(stand)};
  d = {e.x, e.y * std::cos(tilt) - e.z * std::sin(tilt), e.z * std::cos(tilt) + e.y * std::sin(tilt)};
  return (1 + feature.ear_scale) * d - from + Vector3{0, feature.ear_rise_mm, 0};
}

// A mode on its way to the offsets of all vertices.
class Sculpture {
 public:
  Sculpture(const Head& head, const Fields& fields, const IdentityMode& mode)
      : head_(head), fields_(fields), mode_(mode), offsets_(head.mesh.points_mm.size()) {}

  Offsets finish() {
    for (std::uint32_t v = 0; v < head_.skin.vertices.size(); ++v) offsets_[v] = pushed(mode_, point(v));
    move_eye(head_.eyes.left, head_.skin.left_eye_rings, false);
    move_eye(head_.eyes.right, head_.skin.right_eye_rings, true);
    move_mouth();
    const std::uint32_t ears_middle = (head_.ears.first + head_.ears.end) / 2;
    move_ear(head_.ears.first, ears_middle, false);
    move_ear(ears_middle, head_.ears.end, true);
    if (mode_.side == Side::both) symmetrise(head_, offsets_);
    for (std::uint32_t v = head_.hair.first; v < head_.hair.end; ++v) offsets_[v] = pushed(mode_, point(v));
    return offsets_;
  }

 private:
  Vector3 point(std::uint32_t v) const { return head_.mesh.points_mm[v]; }
  // A feature is told for the left side; the right one has it mirrored, with the mode's sign.
  template <class Of>
  Vector3 on_side(bool right, Vector3 p, Of of) const {
    if (!right) return of(p);
    return (mode_.side == Side::opposite ? -1.0 : 1.0) * phantom::mirrored(of(phantom::mirrored(p)));
  }

  // Ball and lids move as one; what the skin outside does otherwise begins over the outer rings.
  void move_eye(VertexRange ball, const std::vector<std::vector<std::uint32_t>>& rings, bool right) {
    Vector3 mean;
    const std::vector<std::uint32_t>& edge = rings[static_cast<std::size_t>(-kEyeDeepestRing)];
    for (const std::uint32_t v : edge) mean += offsets_[v] * (1.0 / static_cast<double>(edge.size()));
    const auto with_eye = [&](Vector3 p) { return eye_feature(mode_.feature, p); };
    for (std::uint32_t v = ball.first; v < ball.end; ++v) offsets_[v] = mean + on_side(right, point(v), with_eye);
    for (const std::vector<std::uint32_t>& ring : rings)
      for (const std::uint32_t v : ring) {
        const SkinVertex& vertex = head_.skin.vertices[v];
        const double free = smooth_step(2, 6.5, vertex.ring);
        const auto lid = [&](Vector3 p) { return lid_feature(mode_.feature, vertex, p); };
        offsets_[v] =
            lerp(mean + on_side(right, point(v), with_eye), offsets_[v], free) + on_side(right, point(v), lid);
      }
  }

  // Teeth, gums and tongue move with the middle of the lips, and the mouth's lining goes over from lips to throat.
  void move_mouth() {
    Vector3 mean;
    double count = 0;
    for (int c = 0; c < kMouthColumns; ++c) {
      if (std::abs(lip_position(c)) > 0.6) continue;
      mean += offsets_[head_.skin.mouth(kLipContactRing, c)];
      ++count;
    }
    mean = mean * (1 / count);
    for (std::uint32_t v = 0; v < head_.skin.vertices.size(); ++v) {
      const SkinVertex& vertex = head_.skin.vertices[v];
      offsets_[v] = lerp(mean, offsets_[v], fields_.lining[v]) + lip_feature(mode_.feature, fields_, vertex, v);
    }
    const MouthInterior& mouth = head_.mouth;
    for (const VertexRange& range :
         {mouth.upper_teeth, mouth.lower_teeth, mouth.upper_gums, mouth.lower_gums, mouth.tongue})
      for (std::uint32_t v = range.first; v < range.end; ++v) offsets_[v] = mean;
  }

  void move_ear(std::uint32_t first, std::uint32_t end, bool right) {
    const Vector3 root = pushed(mode_, right ? phantom::mirrored(kEarRoot) : kEarRoot);
    const auto ear = [&](Vector3 p) { return ear_feature(mode_.feature, p); };
    for (std::uint32_t v = first; v < end; ++v) offsets_[v] = root + on_side(right, point(v), ear);
  }

  const Head& head_;
  const Fields& fields_;
  const IdentityMode& mode_;
  Offsets offsets_;
};

}  // namespace

ShapeSet identity_modes(const MakeHeadOptions& options) {
  const Head head = neutral_head(options);
  const Fields fields = measure_fields(head);
  ShapeSet modes;
  for (const IdentityMode& mode : identity_table())
    modes.shapes.push_back(to_shape(head, mode.name, Sculpture(head, fields, mode).finish()));
  return modes;
}

}  // namespace face::phantom
