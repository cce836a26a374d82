// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "nodes/phantom/vector3.h"
#include "nodes/types/rig.h"

namespace face::phantom {

inline Vector3 to_vector(const Vec3f& p) { return {p[0], p[1], p[2]}; }

// The part of every vertex (index into Mesh::parts; that of its first polygon), parts.size() where it has none.
std::vector<std::size_t> vertex_parts(const Mesh& mesh);

// Whether a part of this name is skin ("face", "head", "ears"), in the mouth (teeth, gums, tongue) or an eyeball of
// a side ("left", "right").
bool is_skin(std::string_view part);
bool is_in_mouth(std::string_view part);
bool is_eyeball(std::string_view part, std::string_view side);

// Fan triangles of the part "face".
std::vector<std::array<std::uint32_t, 3>> face_triangles(const Mesh& mesh);

// Where things are on a face, seen from the front, by its 68 landmarks. Lengths in mm.
class FacePlaces {
 public:
  // Throws where the rig has no 68 landmarks.
  explicit FacePlaces(const Rig& rig);

  Vector3 mark(std::size_t landmark) const { return marks_[landmark]; }
  // Signed distance to the outer edge of the lips' red in the front view, negative inside.
  double from_lips_mm(Vector3 p) const { return from_outline(lips_, p); }
  // The same to the openings of the eyes: the smaller of both.
  double from_eyes_mm(Vector3 p) const { return std::min(from_outline(right_eye_, p), from_outline(left_eye_, p)); }
  // Distance to the lines of the brows.
  double from_brows_mm(Vector3 p) const;
  // 1 on the front of the face, 0 on its sides behind the jaw line's ends and inside the mouth.
  double front(Vector3 p) const;
  // 1 where a beard grows.
  double beard(Vector3 p) const;

 private:
  using Outline = std::vector<std::array<double, 2>>;
  static double from_outline(const Outline& outline, Vector3 p);
  Outline smooth_outline(std::size_t first, std::size_t end) const;

  std::vector<Vector3> marks_;
  Outline lips_, right_eye_, left_eye_;
};

}  // namespace face::phantom
