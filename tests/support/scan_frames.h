// SPDX-License-Identifier: Apache-2.0
// Frames of an ideal scanner that looks at the embedded head, with exact correspondence: what tests of flow, masks,
// markers and models are judged by. Skin has pores and freckles that move with it and white dots; light stands still.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "nodes/base/pose.h"
#include "nodes/base/random.h"
#include "nodes/phantom/make_head.h"
#include "nodes/render/camera.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"

namespace test {

struct ScanLook {
  int width = 640;
  int height = 480;
  double noise_mm = 0;
  double noise_grey = 0;
  double dot_radius_mm = 2.2;
  bool light = true;  // else plain albedo
  std::uint64_t seed = 1;
};

// A smooth random field over space, about -1 to 1: values at the corners of a lattice, cubic blends between.
inline double lattice_noise(const face::Vec3f& p, double cell_mm, std::uint64_t seed) {
  std::array<double, 3> base{}, blend{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double q = p[k] / cell_mm + 1000;
    base[k] = std::floor(q);
    const double f = q - base[k];
    blend[k] = f * f * (3 - 2 * f);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::uint64_t key = seed;
    for (std::size_t k = 0; k < 3; ++k) {
      const int bit = (corner >> k) & 1;
      weight *= bit ? blend[k] : 1 - blend[k];
      key = key * 4093 + static_cast<std::uint64_t>(base[k] + bit);
    }
    sum += weight * face::Random(key).uniform(-1, 1);
  }
  return sum;
}

class ScanScene {
 public:
  explicit ScanScene(const ScanLook& look = {}) : look_(look), rig_(face::phantom::make_head({.with_hair = false})) {
    triangles_ = face::render::triangulate(rig_.neutral).triangles;
    for (const auto part : face::render::triangulate(rig_.neutral).parts) part_of_.push_back(part);
    camera = face::render::orbit_camera({0, 5, 40}, 600, 0, 0, 26, look.width, look.height);
    place_dots();
    paint();
  }

  face::Camera camera;
  const face::Rig& rig() const { return rig_; }
  const std::vector<face::render::Triangle>& triangles() const { return triangles_; }
  const std::vector<face::Vec3f>& dots_neutral() const { return dots_; }

  // Points of a pose, moved rigidly.
  std::vector<face::Vec3f> points(const std::map<std::string, float>& weights,
                                  const face::RigidMotion& motion = {}) const {
    face::Weights w;
    for (const face::Shape& shape : rig_.shapes) {
      const auto found = weights.find(shape.name);
      w.values.push_back(found == weights.end() ? 0.0f : found->second);
    }
    std::vector<face::Vec3f> out = face::pose_points(rig_, w);
    for (face::Vec3f& p : out) {
      face::Vec3f moved{};
      for (std::size_t r = 0; r < 3; ++r) {
        double sum = motion.translation_mm[r];
        for (std::size_t c = 0; c < 3; ++c) sum += motion.rotation[r * 3 + c] * static_cast<double>(p[c]);
        moved[r] = static_cast<float>(sum);
      }
      p = moved;
    }
    return out;
  }

  struct Frame {
    face::DepthScan scan;
    face::render::Raster raster;
    std::vector<face::render::ScreenPoint> screen;
    std::vector<face::Vec3f> points_mm;
    std::vector<bool> inside_mouth;  // height x width: teeth, tongue, gums, mouth, eyeballs are not skin
  };

  Frame frame(const std::vector<face::Vec3f>& points_mm, std::uint64_t noise_seed = 1) const {
    Frame out;
    out.points_mm = points_mm;
    out.screen = face::render::project(camera, points_mm);
    face::render::RasterOptions options;
    options.width_px = look_.width;
    options.height_px = look_.height;
    out.raster = face::render::rasterize(out.screen, triangles_, options);
    const std::vector<face::Vec3f> normals = face::render::vertex_normals(points_mm, triangles_);
    face::DepthScan& scan = out.scan;
    scan.camera = camera;
    const std::size_t count = out.raster.triangles.size();
    scan.picture = {look_.width, look_.height, 1, std::vector<std::uint8_t>(count, 12)};
    scan.depth_mm.assign(count, 0);
    out.inside_mouth.assign(count, false);
    face::Random noise(look_.seed, noise_seed);
    for (int y = 0; y < look_.height; ++y)
      for (int x = 0; x < look_.width; ++x) {
        const std::size_t i = out.raster.index(x, y);
        const int t = out.raster.triangles[i];
        if (t < 0) continue;
        const auto& triangle = triangles_[static_cast<std::size_t>(t)];
        const face::Vec3f b =
            face::render::barycentrics_at(out.screen, triangle, static_cast<float>(x), static_cast<float>(y));
        scan.depth_mm[i] = 1 / out.raster.inverse_depth_per_mm[i] + static_cast<float>(look_.noise_mm * noise.normal());
        face::Vec3f rest{}, normal{};
        double albedo = 0;
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t axis = 0; axis < 3; ++axis) {
            rest[axis] += b[k] * rig_.neutral.points_mm[triangle[k]][axis];
            normal[axis] += b[k] * normals[triangle[k]][axis];
          }
        for (std::size_t k = 0; k < 3; ++k) albedo += static_cast<double>(b[k] * albedo_[triangle[k]]);
        const std::string& part = rig_.neutral.parts[part_of_[static_cast<std::size_t>(t)]].name;
        const bool skin = part == "face" || part == "head" || part == "ears" || part == "neck";
        out.inside_mouth[i] = !skin;
        if (skin) {
          albedo +=
              7 * lattice_noise(rest, 1.6, 11) + 7 * lattice_noise(rest, 3.7, 12) + 8 * lattice_noise(rest, 9, 13);
          double dot = 1e9;
          for (const face::Vec3f& d : dots_)
            dot = std::min(dot, std::hypot(static_cast<double>(d[0] - rest[0]), static_cast<double>(d[1] - rest[1]),
                                           static_cast<double>(d[2] - rest[2])));
          const double share = std::clamp((look_.dot_radius_mm - dot) / 0.8 + 0.5, 0.0, 1.0);
          albedo += share * (235 - albedo);
        }
        const double length =
            std::hypot(static_cast<double>(normal[0]), static_cast<double>(normal[1]), static_cast<double>(normal[2]));
        const double shade =
            look_.light
                ? 0.35 + 0.65 * std::max(0.0, (0.25 * static_cast<double>(normal[1]) + static_cast<double>(normal[2])) /
                                                  (1.04 * std::max(length, 1e-9)))
                : 1;
        scan.picture.pixels[i] = static_cast<std::uint8_t>(
            std::clamp(std::lround(albedo * shade + look_.noise_grey * noise.normal()), 0l, 255l));
      }
    return out;
  }

  // Where every skin pixel of one frame is in another; valid where it is seen there.
  face::FlowField truth(const Frame& from, const Frame& to) const {
    face::FlowField field{look_.width, look_.height, {}, {}};
    const std::size_t count = from.raster.triangles.size();
    field.displacement_px.assign(count, {0, 0});
    field.valid.assign(count, 0);
    for (int y = 0; y < look_.height; ++y)
      for (int x = 0; x < look_.width; ++x) {
        const std::size_t i = from.raster.index(x, y);
        const int t = from.raster.triangles[i];
        if (t < 0 || from.inside_mouth[i]) continue;
        const face::render::ScreenPoint p = place(from, to, static_cast<std::size_t>(t), x, y);
        field.displacement_px[i] = {p.x_px - static_cast<float>(x), p.y_px - static_cast<float>(y)};
        const int nx = static_cast<int>(std::lround(p.x_px)), ny = static_cast<int>(std::lround(p.y_px));
        if (nx < 1 || ny < 1 || nx + 1 >= look_.width || ny + 1 >= look_.height) continue;
        const float seen = to.scan.depth_mm[to.raster.index(nx, ny)];
        field.valid[i] = seen > 0 && std::fabs(seen - p.depth_mm) < 2.5f ? 1 : 0;
      }
    return field;
  }

  // The dots as seen in a frame; valid where they are seen.
  face::Landmarks dots(const Frame& frame) const {
    face::Landmarks out;
    for (std::size_t d = 0; d < dots_.size(); ++d) {
      face::Vec3f p{};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
          p[axis] += dot_weights_[d][k] * frame.points_mm[triangles_[dot_triangles_[d]][k]][axis];
      const face::render::ScreenPoint s = face::render::project(camera, p);
      const int x = static_cast<int>(std::lround(s.x_px)), y = static_cast<int>(std::lround(s.y_px));
      bool seen = x >= 0 && y >= 0 && x < look_.width && y < look_.height;
      if (seen) seen = std::fabs(frame.scan.depth_mm[frame.raster.index(x, y)] - s.depth_mm) < 2.5f;
      out.points.push_back(
          {"dot_" + std::to_string(d), static_cast<double>(s.x_px), static_cast<double>(s.y_px), seen});
    }
    return out;
  }

 private:
  face::render::ScreenPoint place(const Frame& from, const Frame& to, std::size_t t, int x, int y) const {
    const auto& triangle = triangles_[t];
    const face::Vec3f b =
        face::render::barycentrics_at(from.screen, triangle, static_cast<float>(x), static_cast<float>(y));
    face::Vec3f p{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += b[k] * to.points_mm[triangle[k]][axis];
    return face::render::project(camera, p);
  }

  // A grid of dots over the front of the neutral face, at the points where rays of an upright grid meet it.
  void place_dots() {
    const auto screen = face::render::project(camera, rig_.neutral.points_mm);
    face::render::RasterOptions options;
    options.width_px = look_.width;
    options.height_px = look_.height;
    const auto raster = face::render::rasterize(screen, triangles_, options);
    for (int row = 0; row < 9; ++row)
      for (int column = 0; column < 7; ++column) {
        const face::Vec3f aim{static_cast<float>((column - 3) * 18 + (row % 2) * 9 - 4),
                              static_cast<float>(75 - row * 18), 60};
        const auto s = face::render::project(camera, aim);
        const int x = static_cast<int>(std::lround(s.x_px)), y = static_cast<int>(std::lround(s.y_px));
        if (x < 0 || y < 0 || x >= look_.width || y >= look_.height) continue;
        const int t = raster.triangles[raster.index(x, y)];
        if (t < 0 || rig_.neutral.parts[part_of_[static_cast<std::size_t>(t)]].name != "face") continue;
        const auto& triangle = triangles_[static_cast<std::size_t>(t)];
        const face::Vec3f b =
            face::render::barycentrics_at(screen, triangle, static_cast<float>(x), static_cast<float>(y));
        face::Vec3f p{};
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += b[k] * rig_.neutral.points_mm[triangle[k]][axis];
        dots_.push_back(p);
        dot_triangles_.push_back(static_cast<std::size_t>(t));
        dot_weights_.push_back(b);
      }
  }

  void paint() {
    albedo_.assign(rig_.neutral.points_mm.size(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const face::Part& part = rig_.neutral.parts[part_of_[t]];
      for (const auto v : triangles_[t]) {
        face::Vec3f colour = part.albedo_srgb;
        if (!rig_.neutral.colors_srgb.empty())
          for (std::size_t k = 0; k < 3; ++k) colour[k] *= rig_.neutral.colors_srgb[v][k];
        albedo_[v] = 220 * (0.299f * colour[0] + 0.587f * colour[1] + 0.114f * colour[2]);
      }
    }
  }

  ScanLook look_;
  face::Rig rig_;
  std::vector<face::render::Triangle> triangles_;
  std::vector<std::uint16_t> part_of_;
  std::vector<float> albedo_;
  std::vector<face::Vec3f> dots_;
  std::vector<std::size_t> dot_triangles_;
  std::vector<face::Vec3f> dot_weights_;
};

}  // namespace test
