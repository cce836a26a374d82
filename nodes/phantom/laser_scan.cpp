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
#include "nodes/phantom/vector3.h"
#include "nodes/render/shade.h"

namespace face::phantom {
namespace {

bool is_hair(const Part& part) { return part.name.find("hair") != std::string::npos; }

// The triangles of a head in the picture (phi, h): three corners of their own each, those across the seam twice.
struct Unrolled {
  std::vector<render::ScreenPoint> corners;
  std::vector<render::Triangle> triangles;
  std::vector<std::uint32_t> source;  // of every triangle
};

constexpr float far_mm = 1000;  // no head reaches so far from its axis

Unrolled unroll(const std::vector<Vec3f>& points_mm, const std::vector<render::Triangle>& triangles,
                const std::vector<bool>& left_out, const LaserScanOptions& options) {
  const auto columns = static_cast<float>(options.columns);
  const float per_rad = columns / (2 * std::numbers::pi_v<float>);
  Unrolled unrolled;
  std::vector<render::ScreenPoint> screen(points_mm.size());
  for (std::size_t v = 0; v < points_mm.size(); ++v) {
    const float x = points_mm[v][0] - static_cast<float>(options.axis_x_mm);
    const float z = points_mm[v][2] - static_cast<float>(options.axis_z_mm);
    const float radius = std::hypot(x, z);
    check(radius < far_mm, "vertex ", v, " is ", radius, " mm from the axis, expected less than ", far_mm);
    // The rasteriser keeps the larger 1 / depth: here the outermost.
    screen[v] = {0.5f * (columns - 1) + per_rad * std::atan2(x, z),
                 static_cast<float>((options.top_mm - points_mm[v][1]) / options.step_mm), far_mm / radius};
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (left_out[t]) continue;
    std::array<render::ScreenPoint, 3> corner;
    float least = 1e9f, most = -1e9f;
    for (std::size_t i = 0; i < 3; ++i) {
      corner[i] = screen[triangles[t][i]];
      const float turn = std::round((corner[i].x_px - corner[0].x_px) / columns);
      corner[i].x_px -= columns * turn;
      least = std::min(least, corner[i].x_px);
      most = std::max(most, corner[i].x_px);
    }
    if (most - least > 0.45f * columns) continue;  // about the axis itself, at the crown, where scanners see nothing
    const auto add = [&](float shift) {
      const auto first = static_cast<std::uint32_t>(unrolled.corners.size());
      for (render::ScreenPoint point : corner) {
        point.x_px += shift;
        unrolled.corners.push_back(point);
      }
      unrolled.triangles.push_back({first, first + 1, first + 2});
      unrolled.source.push_back(static_cast<std::uint32_t>(t));
    };
    add(0);
    if (least < 0) add(columns);
    if (most > columns - 1) add(-columns);
  }
  return unrolled;
}

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

}  // namespace

LaserScanResult laser_scan(const Rig& rig, const Weights& weights, const SurfaceDots* dots, const std::string* id,
                           const LaserScanOptions& options) {
  constexpr Vec3f cap_colour = {0.62f, 0.64f, 0.68f};  // linear
  constexpr double cap_mm = 1.2;
  check(options.rows > 0 && options.columns > 0, "the scan is ", options.rows, " x ", options.columns,
        ", expected at least 1 x 1");
  check(options.step_mm > 0, "step_mm is ", options.step_mm, ", expected more than 0");
  const Mesh& mesh = rig.neutral;
  check(mesh.colors_srgb.empty() || mesh.colors_srgb.size() == mesh.points_mm.size(), "the rig has ",
        mesh.colors_srgb.size(), " vertex colours, but ", mesh.points_mm.size(), " vertices");
  const OpaqueTriangles opaque = opaque_triangles(mesh);
  const render::Triangulation& triangles = opaque.mesh;
  std::vector<Vec3f> points_mm = pose_points(rig, weights);
  const std::vector<Vec3f> normals = render::vertex_normals(points_mm, triangles.triangles);
  const render::SrgbTable srgb;
  std::vector<Vec3f> albedo(points_mm.size(), Vec3f{1, 1, 1});
  for (std::size_t v = 0; v < mesh.colors_srgb.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) albedo[v][c] = srgb.linear(mesh.colors_srgb[v][c]);
  std::vector<float> above_cap_edge_mm;  // V; empty without a cap
  if (options.bathing_cap) above_cap_edge_mm = height_above_cap_edge(rig);
  const auto is_skin = [&](std::uint16_t part) {
    return mesh.parts.empty() || mesh.parts[part].name == "face" || mesh.parts[part].name == "head";
  };
  const std::vector<std::uint16_t> part_of = part_of_vertices(points_mm.size(), triangles);
  for (std::size_t v = 0; v < above_cap_edge_mm.size(); ++v) {
    const auto thickness =
        static_cast<float>(is_skin(part_of[v]) ? cap_mm * smooth_step(0, 4, above_cap_edge_mm[v]) : 0);
    for (std::size_t c = 0; c < 3; ++c) points_mm[v][c] += thickness * normals[v][c];
  }
  std::vector<bool> left_out(triangles.triangles.size(), false);
  std::vector<Vec3f> part_albedo(std::max<std::size_t>(1, mesh.parts.size()), Vec3f{1, 1, 1});
  for (std::size_t p = 0; p < mesh.parts.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c) part_albedo[p][c] = srgb.linear(mesh.parts[p].albedo_srgb[c]);
  if (options.bathing_cap)
    for (std::size_t t = 0; t < left_out.size(); ++t)
      left_out[t] = !mesh.parts.empty() && is_hair(mesh.parts[triangles.parts[t]]);
  const Unrolled unrolled = unroll(points_mm, triangles.triangles, left_out, options);
  render::RasterOptions raster_options;
  raster_options.width_px = options.columns;
  raster_options.height_px = options.rows;
  raster_options.culling = render::Culling::none;
  const render::Raster raster = render::rasterize(unrolled.corners, unrolled.triangles, raster_options);

  const DotPainter painter(dots, points_mm, triangles, ColourSpace::linear);
  const std::string name = id == nullptr ? std::string() : *id;
  const PixelNoise radius_noise(options.seed, name, 0), dropout(options.seed, name, 1), grain(options.seed, name, 2),
      patches(options.seed, name, 3);
  const NormalTable normal_of;
  const SrgbCurve curve;
  const double steepest = std::cos(options.max_angle_deg * std::numbers::pi / 180);
  const double phi_step = 2 * std::numbers::pi / options.columns;

  LaserScanResult result;
  CylinderScan& scan = result.scan;
  scan.axis.origin_mm = {static_cast<float>(options.axis_x_mm), 0, static_cast<float>(options.axis_z_mm)};
  scan.top_mm = static_cast<float>(options.top_mm);
  scan.step_mm = static_cast<float>(options.step_mm);
  scan.phi_step_rad = static_cast<float>(phi_step);
  scan.picture = {options.columns, options.rows, 3, {}};
  scan.picture.pixels.assign(raster.triangles.size() * 3, 0);
  scan.radius_mm.assign(raster.triangles.size(), 0.0f);
  result.truth = {options.columns, options.rows, std::vector<std::int32_t>(raster.triangles.size(), -1),
                  std::vector<Vec2f>(raster.triangles.size(), Vec2f{0, 0})};
  for (int row = 0; row < options.rows; ++row)
    for (int column = 0; column < options.columns; ++column) {
      const std::size_t pixel = raster.index(column, row);
      if (raster.triangles[pixel] < 0) continue;
      const std::size_t t = unrolled.source[static_cast<std::size_t>(raster.triangles[pixel])];
      const render::Triangle& triangle = triangles.triangles[t];
      const double phi = (column - 0.5 * (options.columns - 1)) * phi_step;
      const Vector3 ray = {std::sin(phi), 0, std::cos(phi)};
      const Hit hit =
          meet({options.axis_x_mm, options.top_mm - row * options.step_mm, options.axis_z_mm}, ray,
               to_vector(points_mm[triangle[0]]), to_vector(points_mm[triangle[1]]), to_vector(points_mm[triangle[2]]));
      // Edges are straight in the raster and curved in truth: a ray just beside a triangle still meets its plane.
      constexpr float beside = -0.25f;
      if (!(hit.radius_mm > 0) || *std::min_element(hit.weights.begin(), hit.weights.end()) < beside) continue;
      result.truth.triangle[pixel] = opaque.fan_index[t];
      result.truth.weights[pixel] = {hit.weights[0], hit.weights[1]};
      Vec3f point = {0, 0, 0}, normal = {0, 0, 0}, colour = {0, 0, 0};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          point[c] += hit.weights[i] * points_mm[triangle[i]][c];
          normal[c] += hit.weights[i] * normals[triangle[i]][c];
          colour[c] += hit.weights[i] * albedo[triangle[i]][c];
        }
      const std::uint16_t part = triangles.parts[t];
      for (std::size_t c = 0; c < 3; ++c) colour[c] *= part_albedo[part][c];
      painter.paint(point, part, colour);
      if (!above_cap_edge_mm.empty() && is_skin(part)) {
        float above = 0;
        for (std::size_t i = 0; i < 3; ++i) above += hit.weights[i] * above_cap_edge_mm[triangle[i]];
        const auto cover = static_cast<float>(smooth_step(-0.5, 0.5, above));
        for (std::size_t c = 0; c < 3; ++c) colour[c] += cover * (cap_colour[c] - colour[c]);
      }
      const double cosine = std::abs(dot(unit(to_vector(normal)), ray));
      const double light = 1 - options.shading + options.shading * cosine;
      std::uint64_t random = grain.bits(pixel);
      for (std::size_t c = 0; c < 3; ++c, random >>= 12) {
        float level = 255 * curve(static_cast<float>(light) * colour[c]);
        if (options.colour_noise > 0) level += static_cast<float>(options.colour_noise) * normal_of[random];
        scan.picture.pixels[3 * pixel + c] = static_cast<std::uint8_t>(std::clamp(level, 0.0f, 255.0f) + 0.5f);
      }
      if (cosine < steepest) continue;
      if (options.dropouts > 0 && dropout.uniform(pixel) < static_cast<float>(options.dropouts)) continue;
      if (options.missing_hair > 0 && !mesh.parts.empty() && is_hair(mesh.parts[part]) &&
          is_patch_missing(point, patches, static_cast<float>(options.missing_hair)))
        continue;
      double radius = hit.radius_mm;
      if (options.noise_mm > 0) radius += options.noise_mm * radius_noise.normal(pixel);
      if (options.radius_step_mm > 0) radius = options.radius_step_mm * std::round(radius / options.radius_step_mm);
      scan.radius_mm[pixel] = static_cast<float>(std::max(0.0, radius));
    }
  return result;
}

}  // namespace face::phantom
