// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/laser_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/phantom/dot_painter.h"
#include "nodes/phantom/face_places.h"
#include "nodes/phantom/head_view.h"
#include "nodes/phantom/sensor_noise.h"
#include "nodes/phantom/srgb_curve.h"
#include "nodes/phantom/unroll_head.h"
#include "nodes/phantom/vector3.h"
#include "nodes/render/shade.h"

namespace face::phantom {
namespace {

// Where the ray from the axis meets a triangle's plane: the distance, and the barycentric coordinates.
struct Hit {
  double radius_mm = 0;
  Vec3f weights = {1, 0, 0};
};

Hit meet(const Vector3& from, const Vector3& direction, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = cross(b - a, c - a);
  const double towards = dot(normal, direction);
  Hit hit;
  if (towards == 0) return hit;
  hit.radius_mm = dot(normal, a - from) / towards;
  const Vector3 p = from + direction * hit.radius_mm;
  const double area = dot(normal, normal);
  const double wa = dot(normal, cross(c - b, p - b)) / area, wb = dot(normal, cross(a - c, p - c)) / area;
  hit.weights = {static_cast<float>(wa), static_cast<float>(wb), static_cast<float>(1 - wa - wb)};
  return hit;
}

// Height of each vertex of the neutral head above the edge of a bathing cap, mm; empty without landmarks.
std::vector<float> height_above_cap_edge(const Rig& rig) {
  std::vector<float> height;
  if (rig.landmarks68.size() != 68) return height;
  const std::vector<Vec3f>& points = rig.neutral.points_mm;
  float brows = -1e9f;
  for (std::size_t i = 17; i < 27; ++i) brows = std::max(brows, points[rig.landmarks68[i]][1]);
  const Vec3f& front = points[rig.landmarks68[27]];
  const float face = brows - points[rig.landmarks68[8]][1];
  // A straight line in the side view, from a third of a face above the brows at the front to the nape.
  constexpr float slope = 0.75f;
  height.resize(points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    height[v] = points[v][1] - (brows + 0.3f * face - slope * (front[2] - points[v][2]));
  return height;
}

// One random number for every bent cube of the head, so that what is missing is missing in patches.
bool is_patch_missing(const Vec3f& point_mm, const PixelNoise& noise, float share) {
  constexpr float patch_mm = 5;
  std::uint64_t cell = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float bent = point_mm[axis] + 2.5f * std::sin(0.7f * point_mm[(axis + 1) % 3]) +
                       2.5f * std::sin(0.45f * point_mm[(axis + 2) % 3]);
    cell = cell << 20 | (static_cast<std::uint64_t>(std::floor(bent / patch_mm) + 524288.0f) & 0xfffff);
  }
  return noise.uniform(cell) < share;
}

// What the scanner looks at.
struct Sitter {
  const Mesh* mesh = nullptr;
  OpaqueTriangles opaque;
  std::vector<Vec3f> points_mm, normals, albedo;  // V; albedo linear
  std::vector<Vec3f> part_albedo;                 // linear, times albedo
  std::vector<float> above_cap_edge_mm;           // V; empty without a cap

  const std::vector<render::Triangle>& triangles() const { return opaque.mesh.triangles; }
  bool is_skin(std::uint16_t part) const {
    return mesh->parts.empty() || mesh->parts[part].name == "face" || mesh->parts[part].name == "head";
  }
  bool is_hair(std::uint16_t part) const {
    return !mesh->parts.empty() && mesh->parts[part].name.find("hair") != std::string::npos;
  }
};

// The cap lies on the skin.
void put_cap_on(const Rig& rig, Sitter& sitter) {
  constexpr double cap_mm = 1.2;
  sitter.above_cap_edge_mm = height_above_cap_edge(rig);
  const std::vector<std::uint16_t> part_of = part_of_vertices(sitter.points_mm.size(), sitter.opaque.mesh);
  for (std::size_t v = 0; v < sitter.above_cap_edge_mm.size(); ++v) {
    const auto thickness =
        static_cast<float>(sitter.is_skin(part_of[v]) ? cap_mm * smooth_step(0, 4, sitter.above_cap_edge_mm[v]) : 0);
    for (std::size_t c = 0; c < 3; ++c) sitter.points_mm[v][c] += thickness * sitter.normals[v][c];
  }
}

Sitter seat(const Rig& rig, const Weights& weights, bool bathing_cap) {
  const Mesh& mesh = rig.neutral;
  check(mesh.colors_srgb.empty() || mesh.colors_srgb.size() == mesh.points_mm.size(), "the rig has ",
        mesh.colors_srgb.size(), " vertex colours, but ", mesh.points_mm.size(), " vertices");
  Sitter sitter;
  sitter.mesh = &mesh;
  sitter.opaque = opaque_triangles(mesh);
  sitter.points_mm = pose_points(rig, weights);
  sitter.normals = render::vertex_normals(sitter.points_mm, sitter.triangles());
  const render::SrgbTable srgb;
  sitter.albedo.assign(sitter.points_mm.size(), Vec3f{1, 1, 1});
  for (std::size_t v = 0; v < mesh.colors_srgb.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) sitter.albedo[v][c] = srgb.linear(mesh.colors_srgb[v][c]);
  sitter.part_albedo.assign(std::max<std::size_t>(1, mesh.parts.size()), Vec3f{1, 1, 1});
  for (std::size_t p = 0; p < mesh.parts.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c) sitter.part_albedo[p][c] = srgb.linear(mesh.parts[p].albedo_srgb[c]);
  if (bathing_cap) put_cap_on(rig, sitter);
  return sitter;
}

// What a ray meets of it.
struct Spot {
  Vec3f point_mm = {0, 0, 0}, normal = {0, 0, 0}, colour = {0, 0, 0};  // colour linear
  std::uint16_t part = 0;
};

Spot spot_on(const Sitter& sitter, std::size_t t, const Vec3f& weights, const DotPainter& painter) {
  constexpr Vec3f cap_colour = {0.62f, 0.64f, 0.68f};  // linear
  const render::Triangle& triangle = sitter.triangles()[t];
  Spot spot;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      spot.point_mm[c] += weights[i] * sitter.points_mm[triangle[i]][c];
      spot.normal[c] += weights[i] * sitter.normals[triangle[i]][c];
      spot.colour[c] += weights[i] * sitter.albedo[triangle[i]][c];
    }
  spot.part = sitter.opaque.mesh.parts[t];
  for (std::size_t c = 0; c < 3; ++c) spot.colour[c] *= sitter.part_albedo[spot.part][c];
  painter.paint(spot.point_mm, spot.part, spot.colour);
  if (!sitter.above_cap_edge_mm.empty() && sitter.is_skin(spot.part)) {
    float above_mm = 0;
    for (std::size_t i = 0; i < 3; ++i) above_mm += weights[i] * sitter.above_cap_edge_mm[triangle[i]];
    const auto cover = static_cast<float>(smooth_step(-0.5, 0.5, above_mm));
    for (std::size_t c = 0; c < 3; ++c) spot.colour[c] += cover * (cap_colour[c] - spot.colour[c]);
  }
  return spot;
}

// What the scanner makes of what its ray meets, every pixel with its own noise.
class Sensor {
 public:
  Sensor(const LaserScanOptions& options, const std::string& scan)
      : options_(options),
        radius_noise_(options.seed, scan, 0),
        dropout_(options.seed, scan, 1),
        grain_(options.seed, scan, 2),
        patches_(options.seed, scan, 3),
        steepest_(std::cos(options.max_angle_deg * std::numbers::pi / 180)) {}

  // cosine: between the normal and the ray. level: R G B.
  void paint(std::size_t pixel, double cosine, const Vec3f& colour, std::uint8_t* level) const {
    const double light = 1 - options_.shading + options_.shading * cosine;
    std::uint64_t random = grain_.bits(pixel);
    for (std::size_t c = 0; c < 3; ++c, random >>= 12) {
      float value = 255 * curve_(static_cast<float>(light) * colour[c]);
      if (options_.colour_noise > 0) value += static_cast<float>(options_.colour_noise) * normal_of_[random];
      level[c] = static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f);
    }
  }

  // 0 where nothing is measured.
  float measure_mm(std::size_t pixel, double cosine, const Vec3f& point_mm, bool is_hair, double radius_mm) const {
    if (cosine < steepest_) return 0;
    if (options_.dropouts > 0 && dropout_.uniform(pixel) < static_cast<float>(options_.dropouts)) return 0;
    if (options_.missing_hair > 0 && is_hair &&
        is_patch_missing(point_mm, patches_, static_cast<float>(options_.missing_hair)))
      return 0;
    if (options_.noise_mm > 0) radius_mm += options_.noise_mm * radius_noise_.normal(pixel);
    if (options_.radius_step_mm > 0)
      radius_mm = options_.radius_step_mm * std::round(radius_mm / options_.radius_step_mm);
    return static_cast<float>(std::max(0.0, radius_mm));
  }

 private:
  const LaserScanOptions& options_;
  const PixelNoise radius_noise_, dropout_, grain_, patches_;
  const NormalTable normal_of_;
  const SrgbCurve curve_;
  const double steepest_;
};

// Nothing seen yet.
LaserScanResult empty_scan(const LaserScanOptions& options) {
  const auto pixels = static_cast<std::size_t>(options.columns) * static_cast<std::size_t>(options.rows);
  LaserScanResult result;
  CylinderScan& scan = result.scan;
  scan.axis.origin_mm = {static_cast<float>(options.axis_x_mm), 0, static_cast<float>(options.axis_z_mm)};
  scan.top_mm = static_cast<float>(options.top_mm);
  scan.step_mm = static_cast<float>(options.step_mm);
  scan.phi_step_rad = static_cast<float>(2 * std::numbers::pi / options.columns);
  scan.picture = {options.columns, options.rows, 3, {}};
  scan.picture.pixels.assign(pixels * 3, 0);
  scan.radius_mm.assign(pixels, 0.0f);
  result.truth = {options.columns, options.rows, std::vector<std::int32_t>(pixels, -1),
                  std::vector<Vec2f>(pixels, Vec2f{0, 0})};
  return result;
}

}  // namespace

LaserScanResult laser_scan(const Rig& rig, const Weights& weights, const SurfaceDots* dots, const std::string* id,
                           const LaserScanOptions& options) {
  check(options.rows > 0 && options.columns > 0, "the scan is ", options.rows, " x ", options.columns,
        ", expected at least 1 x 1");
  check(options.step_mm > 0, "step_mm is ", options.step_mm, ", expected more than 0");
  const Sitter sitter = seat(rig, weights, options.bathing_cap);
  std::vector<bool> left_out(sitter.triangles().size(), false);
  if (options.bathing_cap)
    for (std::size_t t = 0; t < left_out.size(); ++t) left_out[t] = sitter.is_hair(sitter.opaque.mesh.parts[t]);
  const UnrolledHead unrolled = unroll_head(sitter.points_mm, sitter.triangles(), left_out, options);
  render::RasterOptions raster_options;
  raster_options.width_px = options.columns;
  raster_options.height_px = options.rows;
  raster_options.culling = render::Culling::none;
  const render::Raster raster = render::rasterize(unrolled.corners, unrolled.triangles, raster_options);
  const DotPainter painter(dots, sitter.points_mm, sitter.opaque.mesh, ColourSpace::linear);
  const Sensor sensor(options, id == nullptr ? std::string() : *id);
  const double phi_step_rad = 2 * std::numbers::pi / options.columns;
  LaserScanResult result = empty_scan(options);
  for (int row = 0; row < options.rows; ++row)
    for (int column = 0; column < options.columns; ++column) {
      const std::size_t pixel = raster.index(column, row);
      if (raster.triangles[pixel] < 0) continue;
      const std::size_t t = unrolled.source[static_cast<std::size_t>(raster.triangles[pixel])];
      const auto corner = [&](std::size_t i) { return to_vector(sitter.points_mm[sitter.triangles()[t][i]]); };
      const double phi_rad = (column - 0.5 * (options.columns - 1)) * phi_step_rad;
      const Vector3 axis = {options.axis_x_mm, options.top_mm - row * options.step_mm, options.axis_z_mm};
      const Vector3 ray = {std::sin(phi_rad), 0, std::cos(phi_rad)};
      const Hit hit = meet(axis, ray, corner(0), corner(1), corner(2));
      // Edges are straight in the raster and curved in truth: a ray just beside a triangle still meets its plane.
      constexpr float beside = -0.25f;
      if (!(hit.radius_mm > 0) || *std::min_element(hit.weights.begin(), hit.weights.end()) < beside) continue;
      result.truth.triangle[pixel] = sitter.opaque.fan_index[t];
      result.truth.weights[pixel] = {hit.weights[0], hit.weights[1]};
      const Spot spot = spot_on(sitter, t, hit.weights, painter);
      const double cosine = std::abs(dot(unit(to_vector(spot.normal)), ray));
      sensor.paint(pixel, cosine, spot.colour, &result.scan.picture.pixels[3 * pixel]);
      result.scan.radius_mm[pixel] =
          sensor.measure_mm(pixel, cosine, spot.point_mm, sitter.is_hair(spot.part), hit.radius_mm);
    }
  return result;
}

}  // namespace face::phantom
