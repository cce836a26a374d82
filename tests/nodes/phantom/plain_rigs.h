// SPDX-License-Identifier: Apache-2.0
// Surfaces whose pictures are known by heart: a plane, a ball and a tube, as rigs without shapes or with one.
#pragma once
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/port.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/weights.h"

namespace plain {

// Quads over a grid of (columns + 1) x (rows + 1) points, counter-clockwise seen from where u runs right and v up.
template <class Place>
face::Rig grid(int columns, int rows, Place place, face::Vec3f colour = {0.6f, 0.6f, 0.6f}) {
  face::Rig rig;
  face::Mesh& mesh = rig.neutral;
  for (int v = 0; v <= rows; ++v)
    for (int u = 0; u <= columns; ++u) {
      const std::array<double, 3> p = place(static_cast<double>(u) / columns, static_cast<double>(v) / rows);
      mesh.points_mm.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
      mesh.colors_srgb.push_back(colour);
    }
  mesh.polygon_starts.push_back(0);
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u) {
      const auto at = static_cast<std::uint32_t>(v * (columns + 1) + u), up = static_cast<std::uint32_t>(columns + 1);
      for (const std::uint32_t corner : {at, at + 1, at + 1 + up, at + up}) mesh.corners.push_back(corner);
      mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  return rig;
}

// A square in the plane z = depth.
inline face::Rig wall(double side_mm, double z_mm, int cells = 20) {
  return grid(cells, cells, [=](double u, double v) {
    return std::array<double, 3>{side_mm * (u - 0.5), side_mm * (v - 0.5), z_mm};
  });
}

// A ball about the origin: 1 degree from quad to quad, so it is at most radius * 4e-5 inside the true one.
inline face::Rig ball(double radius_mm) {
  return grid(360, 180, [=](double u, double v) {
    const double phi = 2 * std::numbers::pi * u, theta = std::numbers::pi * (v - 0.5);
    return std::array<double, 3>{radius_mm * std::cos(theta) * std::sin(phi), radius_mm * std::sin(theta),
                                 radius_mm * std::cos(theta) * std::cos(phi)};
  });
}

// An open tube about the y axis.
inline face::Rig tube(double radius_mm, double height_mm) {
  return grid(720, 40, [=](double u, double v) {
    const double phi = 2 * std::numbers::pi * u;
    return std::array<double, 3>{radius_mm * std::sin(phi), height_mm * (v - 0.5), radius_mm * std::cos(phi)};
  });
}

// A window over these frames.
template <class T>
engine::Window<T> window(const std::vector<T>& frames, std::size_t centre) {
  std::vector<std::shared_ptr<const T>> held;
  for (const T& frame : frames) held.push_back(std::make_shared<const T>(frame));
  return {held, centre};
}
inline engine::Window<face::Weights> still_face() { return window<face::Weights>({{}}, 0); }
inline engine::Window<face::RigidMotion> still_head() { return window<face::RigidMotion>({{}}, 0); }

inline face::RigidMotion moved(double x_mm, double y_mm, double z_mm, double yaw_rad = 0) {
  face::RigidMotion motion;
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  motion.rotation = {c, 0, s, 0, 1, 0, -s, 0, c};
  motion.translation_mm = {x_mm, y_mm, z_mm};
  return motion;
}

struct Spread {
  double mean = 0;
  double deviation = 0;
};
inline Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  for (const double value : values) spread.deviation += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(spread.deviation / static_cast<double>(values.size()));
  return spread;
}

}  // namespace plain
