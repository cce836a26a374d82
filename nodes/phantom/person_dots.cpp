// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/person_dots.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/phantom/person_random.h"
#include "nodes/phantom/person_skin.h"

namespace face::phantom {
namespace {

using Corners = std::array<std::uint32_t, 3>;

Vector3 corner(const Rig& rig, const Corners& triangle, std::size_t k) {
  return to_vector(rig.neutral.points_mm[triangle[k]]);
}

// A place told by landmarks: the sum of their positions times weights that sum to 1.
struct Mark {
  int landmark;
  double weight;
};
struct Place {
  const char* name;
  std::vector<Mark> marks;
};

// On the head's right, which has the lower landmarks.
std::vector<Place> right_places() {
  return {{"forehead_inner", {{20, 1}, {27, 0.55}, {33, -0.55}}},
          {"forehead_outer", {{18, 1}, {27, 0.42}, {33, -0.42}}},
          {"brow_inner", {{21, 1}, {27, 0.10}, {33, -0.10}}},
          {"brow_middle", {{19, 1}, {27, 0.12}, {33, -0.12}}},
          {"brow_outer", {{17, 1}, {27, 0.10}, {33, -0.10}}},
          {"temple", {{17, 0.62}, {0, 0.38}}},
          {"eye_outer", {{36, 0.72}, {0, 0.28}}},
          {"nose_side", {{28, 0.55}, {39, 0.45}}},
          {"nose_wing", {{31, 0.75}, {30, 0.25}}},
          {"cheek_inner", {{40, 0.60}, {31, 0.40}}},
          {"cheek_bone", {{41, 0.62}, {48, 0.38}}},
          {"cheek_outer", {{36, 0.52}, {3, 0.48}}},
          {"cheek_side", {{1, 0.72}, {36, 0.28}}},
          {"cheek_middle", {{41, 0.33}, {48, 0.52}, {3, 0.15}}},
          {"cheek_low", {{48, 0.55}, {4, 0.45}}},
          {"smile_fold", {{31, 0.52}, {48, 0.32}, {3, 0.16}}},
          {"upper_lip_inner", {{50, 0.55}, {32, 0.45}}},
          {"upper_lip_outer", {{49, 0.76}, {31, 0.24}}},
          {"mouth_corner", {{48, 1.10}, {54, -0.10}}},
          {"lower_lip_outer", {{59, 0.72}, {6, 0.28}}},
          {"chin_side", {{58, 0.40}, {7, 0.60}}},
          {"jaw_back", {{3, 0.92}, {48, 0.08}}},
          {"jaw_middle", {{4, 0.90}, {48, 0.10}}},
          {"jaw_front", {{6, 0.88}, {57, 0.12}}}};
}
std::vector<Place> middle_places() {
  return {{"forehead_low", {{27, 1.42}, {33, -0.42}}},
          {"forehead_high", {{27, 1.85}, {33, -0.85}}},
          {"nose_root", {{27, 1}}},
          {"nose_ridge", {{28, 0.5}, {29, 0.5}}},
          {"nose_tip", {{30, 1}}},
          {"lower_lip", {{57, 0.72}, {8, 0.28}}},
          {"chin", {{57, 0.25}, {8, 0.75}}}};
}

int mirrored_landmark(int k) {
  constexpr std::array<int, 68> kMirror = {16, 15, 14, 13, 12, 11, 10, 9,  8,  7,  6,  5,  4,  3,  2,  1,  0,
                                           26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 27, 28, 29, 30, 35, 34, 33,
                                           32, 31, 45, 44, 43, 42, 47, 46, 39, 38, 37, 36, 41, 40, 54, 53, 52,
                                           51, 50, 49, 48, 59, 58, 57, 56, 55, 64, 63, 62, 61, 60, 67, 66, 65};
  return kMirror[static_cast<std::size_t>(k)];
}

// Drops a point from the front onto the face: the triangle nearest to the viewer there.
SurfaceDot dropped(const Rig& rig, const std::vector<Corners>& triangles, double x, double y, const std::string& name) {
  SurfaceDot dot;
  dot.name = name;
  double best_z = -1e9;
  for (const Corners& triangle : triangles) {
    const Vector3 a = corner(rig, triangle, 0), b = corner(rig, triangle, 1), c = corner(rig, triangle, 2);
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area < 1e-6) continue;  // seen from behind
    const double u = ((b.x - x) * (c.y - y) - (c.x - x) * (b.y - y)) / area;
    const double v = ((c.x - x) * (a.y - y) - (a.x - x) * (c.y - y)) / area;
    if (u < 0 || v < 0 || u + v > 1) continue;
    const double z = u * a.z + v * b.z + (1 - u - v) * c.z;
    if (z <= best_z) continue;
    best_z = z;
    dot.vertices = triangle;
    dot.weights = to_float({u, v, 1 - u - v});
  }
  check(best_z > -1e9, "no skin of the part \"face\" lies at (", x, ", ", y, ") mm, where ", name, " belongs");
  return dot;
}

}  // namespace

SurfaceDots random_moles(const Rig& rig, const FacePlaces& places, std::int64_t seed, double lightest) {
  std::vector<Corners> triangles;
  std::vector<double> area_below = {0};
  const double chin_y = places.mark(8).y, brow_y = places.mark(19).y, eye_y = places.mark(36).y;
  const double top_y = brow_y + 0.55 * (brow_y - places.mark(33).y);
  for (const Corners& triangle : face_triangles(rig.neutral)) {
    const Vector3 a = corner(rig, triangle, 0), b = corner(rig, triangle, 1), c = corner(rig, triangle, 2);
    const Vector3 p = (a + b + c) * (1.0 / 3), normal = cross(b - a, c - a);
    if (p.y < chin_y || p.y > top_y || normal.z < 0.15 * length(normal) || places.front(p) < 0.95) continue;
    if (places.from_lips_mm(p) < 7 || places.from_eyes_mm(p) < 6 || places.from_brows_mm(p) < 6) continue;
    triangles.push_back(triangle);
    area_below.push_back(area_below.back() + 0.5 * length(normal));
  }
  SurfaceDots dots;
  if (triangles.empty()) return dots;
  Random random = series(seed, 9);
  const auto add = [&](const char* name) -> SurfaceDot& {
    const double at = random.uniform() * area_below.back();
    const auto above = std::upper_bound(area_below.begin() + 1, area_below.end() - 1, at);
    SurfaceDot dot;
    dot.name = name;
    dot.vertices = triangles[static_cast<std::size_t>(above - area_below.begin()) - 1];
    // Uniform over the triangle (Turk, Generating Random Points in Triangles, Graphics Gems, 1990).
    const double root = std::sqrt(random.uniform()), v = random.uniform();
    dot.weights = to_float({1 - root, root * (1 - v), root * v});
    dots.dots.push_back(dot);
    return dots.dots.back();
  };
  const auto size = [&](double least_mm, double most_mm) {
    return static_cast<float>(least_mm + (most_mm - least_mm) * square(random.uniform()));
  };
  const SkinTone tone = skin_tone(seed, lightest);
  const int moles = static_cast<int>(random.uniform(1, 8));
  // Four in ten of the lightest third have freckles.
  const bool freckled = tone.lightness > 0.6 && random.uniform() < 0.4;
  const int freckles = freckled ? static_cast<int>(random.uniform(50, 160)) : 0;
  for (int k = 0; k < freckles; ++k) {
    SurfaceDot& dot = add("freckle");
    const Vector3 p = corner(rig, dot.vertices, 0);
    // They are thickest over the cheeks and the nose.
    const double thick = bell(p.y - 0.5 * (eye_y + places.mark(33).y), 24);
    dot.radius_mm = size(0.5, 1.2);
    dot.edge_mm = dot.radius_mm;
    dot.color_srgb = to_float(Vector3{0.66 * tone.color_srgb.x, 0.52 * tone.color_srgb.y, 0.42 * tone.color_srgb.z});
    dot.opacity = static_cast<float>((0.15 + 0.55 * thick) * random.uniform(0.5, 1));
  }
  for (int k = 0; k < moles; ++k) {
    SurfaceDot& dot = add("mole");
    dot.radius_mm = size(0.7, 2.2);
    dot.edge_mm = 0.5f;
    dot.color_srgb = to_float(0.32 * tone.color_srgb);
    dot.opacity = static_cast<float>(random.uniform(0.65, 0.95));
  }
  return dots;
}

SurfaceDots named_markers(const Rig& rig, const FacePlaces& places, double radius_mm, Vector3 color_srgb) {
  const std::vector<Corners> triangles = face_triangles(rig.neutral);
  SurfaceDots markers;
  const auto add = [&](const Place& place, bool mirror, const std::string& suffix) {
    Vector3 p;
    for (const Mark& mark : place.marks)
      p += mark.weight *
           places.mark(static_cast<std::size_t>(mirror ? mirrored_landmark(mark.landmark) : mark.landmark));
    SurfaceDot dot = dropped(rig, triangles, p.x, p.y, place.name + suffix);
    dot.radius_mm = static_cast<float>(radius_mm);
    dot.edge_mm = static_cast<float>(0.2 * radius_mm);
    dot.color_srgb = to_float(color_srgb);
    markers.dots.push_back(dot);
  };
  for (const Place& place : middle_places()) add(place, false, "");
  for (const Place& place : right_places()) {
    add(place, false, "_right");
    add(place, true, "_left");
  }
  return markers;
}

}  // namespace face::phantom
