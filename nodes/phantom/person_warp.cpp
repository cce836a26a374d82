// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/person_warp.h"

#include <array>
#include <numbers>

#include "nodes/phantom/face_places.h"
#include "nodes/phantom/person_random.h"

namespace face::phantom {
namespace {

using Rows = std::array<Vector3, 3>;  // of a 3 x 3 matrix

Vector3 times(const Rows& m, Vector3 v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

// Solves m x = b for a symmetric positive definite m, by Cramer's rule; 0 where m is singular.
Vector3 solved(const Rows& m, Vector3 b) {
  const Vector3 c0 = cross(m[1], m[2]), c1 = cross(m[2], m[0]), c2 = cross(m[0], m[1]);
  const double det = dot(m[0], c0);
  if (std::abs(det) < 1e-9) return {};
  return (1 / det) * (b.x * c0 + b.y * c1 + b.z * c2);
}

struct Rigid {
  Vector3 centre, shift;
  Rows rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector3 displacement(Vector3 p) const { return shift + times(rotation, p - centre) - (p - centre); }
};

// Rodrigues' formula.
Rows rotation_of(Vector3 turn) {
  const double angle = length(turn);
  const Vector3 k = unit(turn);
  const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
  return {{{c + k.x * k.x * d, k.x * k.y * d - k.z * s, k.x * k.z * d + k.y * s},
           {k.y * k.x * d + k.z * s, c + k.y * k.y * d, k.y * k.z * d - k.x * s},
           {k.z * k.x * d - k.y * s, k.z * k.y * d + k.x * s, c + k.z * k.z * d}}};
}

// The rigid motion nearest to small displacements: shift, and the turn that least squares give to first order.
Rigid nearest_rigid(const std::vector<Vector3>& points, const std::vector<Vector3>& displacements) {
  Rigid rigid;
  if (points.empty()) return rigid;
  const double share = 1 / static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    rigid.centre += share * points[i];
    rigid.shift += share * displacements[i];
  }
  Rows inertia = {};
  Vector3 moment;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 d = points[i] - rigid.centre;
    const double squared = dot(d, d);
    inertia[0] += Vector3{squared - d.x * d.x, -d.x * d.y, -d.x * d.z};
    inertia[1] += Vector3{-d.y * d.x, squared - d.y * d.y, -d.y * d.z};
    inertia[2] += Vector3{-d.z * d.x, -d.z * d.y, squared - d.z * d.z};
    moment += cross(d, displacements[i]);
  }
  rigid.rotation = rotation_of(solved(inertia, moment));
  return rigid;
}

struct Wave {
  Vector3 by, per_mm;
  double phase;
};

constexpr double kShortest_mm = 90, kLongest_mm = 200;

std::vector<Wave> random_waves(std::int64_t seed) {
  Random random = series(seed, 2);
  std::vector<Wave> waves;
  for (int k = 0; k < 10; ++k) {
    const Vector3 by = {random.normal(), random.normal(), random.normal()};
    const Vector3 direction = unit({random.normal(), random.normal(), random.normal()});
    const double wavelength_mm = random.uniform(kShortest_mm, kLongest_mm);
    waves.push_back({by * (wavelength_mm / kLongest_mm), direction * (2 * std::numbers::pi / wavelength_mm),
                     random.uniform(0, 2 * std::numbers::pi)});
  }
  return waves;
}

// A solid of the head and how far around it the skin takes part in its motion: 1 up to `inner`, 0 from `outer` on, in
// units of its half extents.
struct Solid {
  std::vector<std::uint32_t> vertices;
  Vector3 centre, half_mm;
  double inner, outer;
  Rigid motion;
  double share(Vector3 p) const {
    const Vector3 d = p - centre;
    return smooth_step(outer, inner, length({d.x / half_mm.x, d.y / half_mm.y, d.z / half_mm.z}));
  }
};

template <class Belongs>
Solid find_solid(const Mesh& mesh, const std::vector<std::size_t>& parts, Belongs belongs) {
  Solid solid = {};
  Vector3 low = {1e9, 1e9, 1e9}, high = {-1e9, -1e9, -1e9};
  for (std::uint32_t v = 0; v < parts.size(); ++v) {
    if (parts[v] >= mesh.parts.size() || !belongs(mesh.parts[parts[v]].name)) continue;
    solid.vertices.push_back(v);
    const Vector3 p = to_vector(mesh.points_mm[v]);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  solid.centre = 0.5 * (low + high);
  solid.half_mm = 0.5 * (high - low) + Vector3{1, 1, 1};
  return solid;
}

class Warp {
 public:
  Warp(std::int64_t seed, double rms_mm, const Mesh& mesh) : waves_(random_waves(seed)) {
    const std::vector<std::size_t> parts = vertex_parts(mesh);
    std::vector<Vector3> skin, moved;
    for (std::size_t v = 0; v < parts.size(); ++v)
      if (mesh.parts.empty() || (parts[v] < mesh.parts.size() && mesh.parts[parts[v]].name == "face"))
        skin.push_back(to_vector(mesh.points_mm[v]));
    for (const Vector3& p : skin) moved.push_back(wavy(p));
    whole_ = nearest_rigid(skin, moved);
    double squares = 0;
    for (const Vector3& p : skin) squares += dot(wavy(p) - whole_.displacement(p), wavy(p) - whole_.displacement(p));
    scale_ = squares > 0 ? rms_mm / std::sqrt(squares / static_cast<double>(skin.size())) : 0;

    for (const char* side : {"left", "right"}) {
      Solid eye = find_solid(mesh, parts, [&](std::string_view part) { return is_eyeball(part, side); });
      if (eye.vertices.empty()) continue;
      const double radius = std::max({eye.half_mm.x, eye.half_mm.y, eye.half_mm.z});
      eye.half_mm = {radius, radius, radius};
      eye.inner = 1 + 5 / radius;  // the lids
      eye.outer = 1 + 24 / radius;
      solids_.push_back(eye);
    }
    Solid mouth = find_solid(mesh, parts, is_in_mouth);
    if (!mouth.vertices.empty()) {
      mouth.inner = 0.95;
      mouth.outer = 1.45;
      solids_.push_back(mouth);
    }
    for (Solid& solid : solids_) {
      std::vector<Vector3> points, displacements;
      for (const std::uint32_t v : solid.vertices) {
        points.push_back(to_vector(mesh.points_mm[v]));
        displacements.push_back(free(points.back()));
      }
      solid.motion = nearest_rigid(points, displacements);
    }
  }

  const std::vector<Solid>& solids() const { return solids_; }
  Vector3 displacement(Vector3 p) const {
    Vector3 by = free(p);
    for (const Solid& solid : solids_) {
      const double share = solid.share(p);
      if (share > 0) by = lerp(by, solid.motion.displacement(p), share);
    }
    return by;
  }
  // Rows of d (p + displacement) / d p, by central differences.
  Rows jacobian(Vector3 p) const {
    constexpr double h = 0.25;  // mm; the field changes over tens of them
    const Vector3 x = (0.5 / h) * (displacement(p + Vector3{h, 0, 0}) - displacement(p - Vector3{h, 0, 0}));
    const Vector3 y = (0.5 / h) * (displacement(p + Vector3{0, h, 0}) - displacement(p - Vector3{0, h, 0}));
    const Vector3 z = (0.5 / h) * (displacement(p + Vector3{0, 0, h}) - displacement(p - Vector3{0, 0, h}));
    return {{{1 + x.x, y.x, z.x}, {x.y, 1 + y.y, z.y}, {x.z, y.z, 1 + z.z}}};
  }

 private:
  Vector3 wavy(Vector3 p) const {
    Vector3 sum;
    for (const Wave& wave : waves_) sum += std::sin(dot(wave.per_mm, p) + wave.phase) * wave.by;
    return sum;
  }
  Vector3 free(Vector3 p) const { return scale_ * (wavy(p) - whole_.displacement(p)); }

  std::vector<Wave> waves_;
  Rigid whole_;
  double scale_ = 0;
  std::vector<Solid> solids_;
};

}  // namespace

Matrix warp_person(std::int64_t seed, double rms_mm, Rig& person) {
  std::vector<Vec3f>& points = person.neutral.points_mm;
  const Warp warp(seed, rms_mm, person.neutral);
  std::vector<Vector3> moved(points.size());
  std::vector<Rows> jacobians(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    moved[v] = warp.displacement(to_vector(points[v]));
    jacobians[v] = warp.jacobian(to_vector(points[v]));
  }
  for (const Solid& solid : warp.solids())
    for (const std::uint32_t v : solid.vertices) {
      moved[v] = solid.motion.displacement(to_vector(points[v]));
      jacobians[v] = solid.motion.rotation;
    }
  for (Shape& shape : person.shapes)
    for (std::size_t k = 0; k < shape.vertices.size(); ++k)
      shape.offsets_mm[k] = to_float(times(jacobians[shape.vertices[k]], to_vector(shape.offsets_mm[k])));
  Matrix displacement = {points.size(), 3, std::vector<double>(points.size() * 3)};
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3f before = points[v];
    points[v] = to_float(to_vector(before) + moved[v]);
    for (std::size_t k = 0; k < 3; ++k) displacement.at(v, k) = double{points[v][k]} - before[k];
  }
  return displacement;
}

}  // namespace face::phantom
