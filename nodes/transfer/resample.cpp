// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/resample.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/cylinder_lookup.h"
#include "nodes/transfer/mesh_graph.h"

namespace face::transfer {
namespace {

constexpr double scan_depth_mm = 10;

Vec3f moved(const RigidMotion* motion, const Vec3f& p) {
  if (!motion) return p;
  Vec3f out{};
  for (std::size_t r = 0; r < 3; ++r) {
    double sum = motion->translation_mm[r];
    for (std::size_t c = 0; c < 3; ++c) sum += motion->rotation[3 * r + c] * static_cast<double>(p[c]);
    out[r] = static_cast<float>(sum);
  }
  return out;
}

// Colour of every vertex: its own times that of the part that it belongs to; empty where the head has neither.
std::vector<Vec3f> colours_of(const Mesh& mesh) {
  if (mesh.colors_srgb.empty() && mesh.parts.empty()) return {};
  std::vector<Vec3f> colours = mesh.colors_srgb;
  if (colours.empty()) colours.assign(mesh.points_mm.size(), {1, 1, 1});
  check(colours.size() == mesh.points_mm.size(), "head has ", colours.size(), " colours for ", mesh.points_mm.size(),
        " points");
  std::vector<Vec3f> part(colours.size(), {1, 1, 1});
  for (const Part& p : mesh.parts) {
    const std::size_t first = p.first_polygon, last = first + p.polygon_count;
    check(last <= mesh.polygon_count(), "head has a part ", p.name, " that ends at polygon ", last, ", its mesh at ",
          mesh.polygon_count());
    for (std::size_t c = mesh.polygon_starts[first]; c < mesh.polygon_starts[last]; ++c) {
      check(mesh.corners[c] < part.size(), "head has a polygon with vertex ", mesh.corners[c], ", its points end at ",
            part.size());
      part[mesh.corners[c]] = p.albedo_srgb;
    }
  }
  for (std::size_t v = 0; v < colours.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) colours[v][k] *= part[v][k];
  return colours;
}

void check_places(const SurfaceMap& places, const Mesh& mesh) {
  const std::size_t count = mesh.points_mm.size();
  check(places.triangle.size() == count && places.weights.size() == count, "places has ", places.triangle.size(),
        " triangles and ", places.weights.size(), " weights, the mesh ", count, " points");
}

void check_shape(const MeshPoints& shape, const Mesh& mesh) {
  check(shape.points_mm.size() == mesh.points_mm.size(), "shape has ", shape.points_mm.size(), " points, the mesh ",
        mesh.points_mm.size());
}

const render::Triangle& triangle_at(const SurfaceMap& places, std::size_t v, const std::vector<render::Triangle>& all,
                                    std::size_t vertices) {
  const auto t = static_cast<std::size_t>(places.triangle[v]);
  check(t < all.size(), "places names triangle ", t, " at vertex ", v, ", the head has ", all.size());
  for (const std::uint32_t corner : all[t])
    check(corner < vertices, "triangle ", t, " of the head has vertex ", corner, ", its points end at ", vertices);
  return all[t];
}

Vec3f mixed(const render::Triangle& t, const Vec2f& w, const std::vector<Vec3f>& values) {
  const float third = 1 - w[0] - w[1];
  Vec3f out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = w[0] * values[t[0]][k] + w[1] * values[t[1]][k] + third * values[t[2]][k];
  return out;
}

// The known points and, where nothing is known, what moves from shape as those around do.
MeshPoints finished(const Mesh& mesh, const MeshPoints& shape, const std::vector<std::uint8_t>& known,
                    std::vector<Vec3f> points) {
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) points[v][k] = known[v] ? points[v][k] - shape.points_mm[v][k] : 0;
  spread_known(neighbours_of(mesh), known, points);
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) points[v][k] += shape.points_mm[v][k];
  return {std::move(points)};
}

// The inverse of a rotation and translation.
RigidMotion inverse(const RigidMotion& m) {
  RigidMotion out;
  for (std::size_t r = 0; r < 3; ++r) {
    out.translation_mm[r] = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      out.rotation[3 * r + c] = m.rotation[3 * c + r];
      out.translation_mm[r] -= m.rotation[3 * c + r] * m.translation_mm[c];
    }
  }
  return out;
}

}  // namespace

MeshPoints resample(const SurfaceMap& places, const Rig& head, const Weights* weights,
                    const RigidMotion* world_from_head, const Mesh& mesh, const MeshPoints& shape) {
  check_places(places, mesh);
  check_shape(shape, mesh);
  const std::vector<render::Triangle> triangles = render::triangulate(head.neutral, false).triangles;
  const std::vector<Vec3f> posed = weights ? pose_points(head, *weights) : head.neutral.points_mm;
  std::vector<std::uint8_t> known(mesh.points_mm.size(), 0);
  std::vector<Vec3f> points(known.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (places.triangle[v] < 0) continue;
    known[v] = 1;
    points[v] =
        moved(world_from_head, mixed(triangle_at(places, v, triangles, posed.size()), places.weights[v], posed));
  }
  return finished(mesh, shape, known, std::move(points));
}

Mesh resample_colours(const SurfaceMap& places, const Rig& head, const Mesh& mesh) {
  check_places(places, mesh);
  const std::vector<Vec3f> colours = colours_of(head.neutral);
  Mesh out = mesh;
  if (colours.empty()) return out;
  const std::vector<render::Triangle> triangles = render::triangulate(head.neutral, false).triangles;
  std::vector<std::uint8_t> known(mesh.points_mm.size(), 0);
  out.colors_srgb.assign(known.size(), {0.5f, 0.5f, 0.5f});
  for (std::size_t v = 0; v < known.size(); ++v) {
    if (places.triangle[v] < 0) continue;
    known[v] = 1;
    out.colors_srgb[v] = mixed(triangle_at(places, v, triangles, colours.size()), places.weights[v], colours);
  }
  spread_known(neighbours_of(mesh), known, out.colors_srgb);
  return out;
}

ResampleScanResult resample_scan(const SurfaceMap& places, const Rig& head, const MeshPoints& fitted,
                                 const CylinderScan& scan, const RigidMotion* scan_from_model,
                                 const RigidMotion* world_from_model, const Mesh& mesh, const MeshPoints& shape) {
  check_places(places, mesh);
  check_shape(shape, mesh);
  check_cylinder(scan, "scan");
  const std::vector<render::Triangle> triangles = render::triangulate(head.neutral, false).triangles;
  const RigidMotion model_from_scan = scan_from_model ? inverse(*scan_from_model) : RigidMotion{};
  std::vector<std::uint8_t> known(mesh.points_mm.size(), 0), coloured = known;
  std::vector<Vec3f> points(known.size()), colours(known.size(), Vec3f{0.5f, 0.5f, 0.5f});
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (places.triangle[v] < 0) continue;
    const Vec3f p =
        mixed(triangle_at(places, v, triangles, fitted.points_mm.size()), places.weights[v], fitted.points_mm);
    const CylinderPlace place = cylinder_place(scan.axis, p);
    const auto surface = surface_at(scan, place.h_mm, place.phi_rad);
    const bool seen = surface && std::fabs(surface->radius_mm - place.radius_mm) <= scan_depth_mm;
    known[v] = 1;
    points[v] = moved(world_from_model, moved(&model_from_scan, seen ? surface->point_mm : p));
    if (!seen) continue;
    coloured[v] = 1;
    colours[v] = surface->color_srgb;
  }
  ResampleScanResult result{finished(mesh, shape, known, std::move(points)), mesh};
  spread_known(neighbours_of(mesh), coloured, colours);
  result.mesh.points_mm = result.shape.points_mm;
  result.mesh.colors_srgb = std::move(colours);
  return result;
}

SurfaceMap scan_places(const SurfaceMap& truth, const Mesh& mesh, const Rig* head) {
  const std::size_t pixels = static_cast<std::size_t>(truth.width) * static_cast<std::size_t>(truth.height);
  check(truth.triangle.size() == pixels && truth.weights.size() == pixels, "truth has ", truth.triangle.size(),
        " triangles and ", truth.weights.size(), " weights, expected ", truth.width, " x ", truth.height);
  check(mesh.uvs.size() == mesh.points_mm.size(), "mesh has ", mesh.uvs.size(), " uvs, expected one for each of its ",
        mesh.points_mm.size(), " points");
  std::vector<std::uint8_t> behind_lips;  // per triangle of the head
  if (head) {
    const render::Triangulation all = render::triangulate(head->neutral, false);
    for (const std::uint16_t p : all.parts) {
      const std::string part = head->neutral.parts.empty() ? std::string() : head->neutral.parts[p].name;
      const auto holds = [&part](const char* word) { return part.find(word) != std::string::npos; };
      behind_lips.push_back(holds("mouth") || holds("gums") || holds("teeth") || holds("tongue") ? 1 : 0);
    }
  }
  const int count = static_cast<int>(mesh.uvs.size());
  SurfaceMap places{count, 1, std::vector<std::int32_t>(mesh.uvs.size(), -1), std::vector<Vec2f>(mesh.uvs.size())};
  for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
    const int x = static_cast<int>(std::floor(mesh.uvs[v][0] * static_cast<float>(truth.width)));
    const int y = static_cast<int>(std::floor((1 - mesh.uvs[v][1]) * static_cast<float>(truth.height)));
    if (x < 0 || y < 0 || x >= truth.width || y >= truth.height) continue;
    const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width) + static_cast<std::size_t>(x);
    const std::int32_t t = truth.triangle[i];
    check(!head || t < static_cast<std::int32_t>(behind_lips.size()), "truth shows triangle ", t, ", the head has ",
          behind_lips.size());
    if (head && t >= 0 && behind_lips[static_cast<std::size_t>(t)]) continue;
    places.triangle[v] = t;
    places.weights[v] = truth.weights[i];
  }
  return places;
}

}  // namespace face::transfer
