// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/face_places.h"

#include <limits>

#include "nodes/base/check.h"

namespace face::phantom {
namespace {

double from_segment(std::array<double, 2> a, std::array<double, 2> b, double x, double y) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((x - a[0]) * dx + (y - a[1]) * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(x - a[0] - t * dx, y - a[1] - t * dy);
}

}  // namespace

std::vector<std::size_t> vertex_parts(const Mesh& mesh) {
  std::vector<std::size_t> part_of(mesh.points_mm.size(), mesh.parts.size());
  for (std::size_t k = mesh.parts.size(); k > 0; --k) {
    const Part& part = mesh.parts[k - 1];
    for (std::uint32_t i = mesh.polygon_starts[part.first_polygon];
         i < mesh.polygon_starts[part.first_polygon + part.polygon_count]; ++i)
      part_of[mesh.corners[i]] = k - 1;
  }
  return part_of;
}

bool is_skin(std::string_view part) { return part == "face" || part == "head" || part == "ears"; }

bool is_in_mouth(std::string_view part) {
  for (const std::string_view word : {"teeth", "gums", "tongue"})
    if (part.find(word) != std::string_view::npos) return true;
  return false;
}

bool is_eyeball(std::string_view part, std::string_view side) {
  return (part.starts_with("sclera_") || part.starts_with("iris_")) && part.ends_with(side);
}

std::vector<std::array<std::uint32_t, 3>> face_triangles(const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Part& part : mesh.parts) {
    if (part.name != "face") continue;
    for (std::uint32_t f = part.first_polygon; f < part.first_polygon + part.polygon_count; ++f)
      for (std::uint32_t i = mesh.polygon_starts[f] + 1; i + 1 < mesh.polygon_starts[f + 1]; ++i)
        triangles.push_back({mesh.corners[mesh.polygon_starts[f]], mesh.corners[i], mesh.corners[i + 1]});
  }
  return triangles;
}

FacePlaces::FacePlaces(const Rig& rig) {
  check(rig.landmarks68.size() == 68, "the rig has ", rig.landmarks68.size(),
        " landmarks, expected 68: skin, dots and markers are placed by them");
  for (const std::uint32_t v : rig.landmarks68) marks_.push_back(to_vector(rig.neutral.points_mm.at(v)));
  lips_ = smooth_outline(48, 60);
  right_eye_ = smooth_outline(36, 42);
  left_eye_ = smooth_outline(42, 48);
}

// Closed Catmull-Rom curve through the landmarks [first, end).
FacePlaces::Outline FacePlaces::smooth_outline(std::size_t first, std::size_t end) const {
  const std::size_t count = end - first;
  constexpr int kSteps = 8;
  Outline outline;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3 a = marks_[first + (k + count - 1) % count], b = marks_[first + k],
                  c = marks_[first + (k + 1) % count], d = marks_[first + (k + 2) % count];
    for (int step = 0; step < kSteps; ++step) {
      const double t = step / static_cast<double>(kSteps);
      const Vector3 p =
          0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * (t * t) + (3 * b - a - 3 * c + d) * (t * t * t));
      outline.push_back({p.x, p.y});
    }
  }
  return outline;
}

double FacePlaces::from_outline(const Outline& outline, Vector3 p) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const std::array<double, 2> a = outline[k], b = outline[(k + 1) % outline.size()];
    nearest = std::min(nearest, from_segment(a, b, p.x, p.y));
    if ((a[1] > p.y) != (b[1] > p.y) && p.x < a[0] + (b[0] - a[0]) * (p.y - a[1]) / (b[1] - a[1])) inside = !inside;
  }
  return inside ? -nearest : nearest;
}

double FacePlaces::from_brows_mm(Vector3 p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::size_t first : {17u, 22u})
    for (std::size_t k = first; k < first + 4; ++k)
      nearest =
          std::min(nearest, from_segment({marks_[k].x, marks_[k].y}, {marks_[k + 1].x, marks_[k + 1].y}, p.x, p.y));
  return nearest;
}

double FacePlaces::front(Vector3 p) const {
  // The jaw line's ends lie before the ears; lips lie well before them.
  const double ends = 0.5 * (marks_[0].z + marks_[16].z);
  return smooth_step(ends - 5, ends + 15, p.z);
}

double FacePlaces::beard(Vector3 p) const {
  const double mouth_y = 0.5 * (marks_[48].y + marks_[54].y), nose_y = marks_[33].y, chin_y = marks_[8].y;
  const double middle_x = marks_[33].x, ends_z = 0.5 * (marks_[0].z + marks_[16].z);
  const double mouth_half = 0.5 * (marks_[54].x - marks_[48].x), face_half = 0.5 * (marks_[16].x - marks_[0].x);
  const double eye_y = 0.5 * (marks_[36].y + marks_[45].y), x = std::abs(p.x - middle_x);
  // Its upper border rises from below the mouth's corners to the ears.
  const double border = mouth_y - 6 + 0.8 * (eye_y - mouth_y) * square(smooth_step(0.45, 1.05, x / face_half));
  const double jaw = smooth_step(border + 14, border - 16, p.y);
  const double moustache = smooth_step(nose_y + 1, nose_y - 5, p.y) * smooth_step(1.35, 1.0, x / mouth_half) *
                           smooth_step(mouth_y - 12, mouth_y, p.y);
  const double throat = smooth_step(chin_y - 34, chin_y - 6, p.y);
  return std::max(jaw * throat, 0.9 * moustache) * smooth_step(0.2, 2.4, from_lips_mm(p)) *
         smooth_step(ends_z - 26, ends_z + 18, p.z);
}

}  // namespace face::phantom
