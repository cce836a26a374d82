// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/camera.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/weights.h"

namespace face::phantom {

// Sensors look at a head in its own frame: the camera and the lamps move about it instead, which saves moving vertices.
// A null motion is the identity.
Camera camera_in_head(const Camera& camera, const RigidMotion* world_from_head);
Vec3f direction_in_head(const Vec3f& direction_in_world, const RigidMotion* world_from_head);
Vec3f point_in_world(const Vec3f& point_in_head_mm, const RigidMotion* world_from_head);

// A part of eyelashes: half transparent, so no sensor's truth says that it is seen.
bool is_lash(const Part& part);

// The opaque, visible triangles of a mesh, and the number of each in the fan triangulation of all its polygons, which
// is what SurfaceMap::triangle counts.
struct OpaqueTriangles {
  render::Triangulation mesh;
  std::vector<std::int32_t> fan_index;  // as many
};
OpaqueTriangles opaque_triangles(const Mesh& mesh);

// A head before a camera: its opaque triangles, its vertices in the picture, and what every pixel sees.
struct HeadView {
  OpaqueTriangles opaque;
  std::vector<render::ScreenPoint> screen;
  render::Raster raster;
};
HeadView view_head(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head, const Camera& camera,
                   int width_px, int height_px);

// What a raster of opaque.mesh shows, pixel by pixel.
SurfaceMap map_of(const render::Raster& raster, const std::vector<render::ScreenPoint>& screen,
                  const OpaqueTriangles& opaque);

// All triangles of the fan triangulation: what a SurfaceMap's numbers mean.
std::vector<render::Triangle> fan_triangles(const Mesh& mesh);

// Part of every vertex (that of the last triangle that uses it).
std::vector<std::uint16_t> part_of_vertices(std::size_t vertex_count, const render::Triangulation& mesh);

}  // namespace face::phantom
