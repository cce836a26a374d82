// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_mesh.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/base/check_mesh.h"

namespace face::exports {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written little-endian, as it lies in memory");

void append_number(std::string& out, float value) {
  char text[32];
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

void append_count(std::string& out, std::size_t value) { out += std::to_string(value); }

template <class T>
void append_raw(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Names in OBJ end at a blank.
std::string material_name(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') c = '_';
  return name.empty() ? "part" : name;
}

}  // namespace

const std::vector<Vec3f>& frame_points(const Mesh& mesh, const MeshPoints* points) {
  const std::vector<Vec3f>& all = points ? points->points_mm : mesh.points_mm;
  check(all.size() == mesh.points_mm.size(), "points has ", all.size(), " vertices, the mesh has ",
        mesh.points_mm.size());
  for (std::size_t v = 0; v < all.size(); ++v)
    check(std::isfinite(all[v][0]) && std::isfinite(all[v][1]) && std::isfinite(all[v][2]), "vertex ", v, " is at (",
          all[v][0], ", ", all[v][1], ", ", all[v][2], "), expected finite numbers");
  return all;
}

engine::File export_obj(const Mesh& mesh, const MeshPoints* points, const ExportMeshOptions& options) {
  check_mesh(mesh);
  const std::vector<Vec3f>& vertices = frame_points(mesh, points);
  const float scale = units_per_mm(options.unit);
  std::string out = "# Facegraph\n";
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    out += 'v';
    for (const float x : vertices[v]) out += ' ', append_number(out, x * scale);
    if (!mesh.colors_srgb.empty())
      for (const float c : mesh.colors_srgb[v]) out += ' ', append_number(out, c);
    out += '\n';
  }
  const bool textured = !mesh.corner_uvs.empty();
  if (textured)
    for (const Vec2f& uv : mesh.uvs) {
      out += "vt ";
      append_number(out, uv[0]);
      out += ' ';
      append_number(out, uv[1]);
      out += '\n';
    }
  auto part = mesh.parts.begin();
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p) {
    for (; part != mesh.parts.end() && part->first_polygon == p; ++part)
      out += "usemtl " + material_name(part->name) + "\n";
    out += 'f';
    for (std::size_t c = mesh.polygon_starts[p]; c < mesh.polygon_starts[p + 1]; ++c) {
      out += ' ';
      append_count(out, mesh.corners[c] + std::size_t{1});
      if (textured) out += '/', append_count(out, mesh.corner_uvs[c] + std::size_t{1});
    }
    out += '\n';
  }
  return engine::File::from_bytes(std::move(out), ".obj");
}

engine::File export_ply(const Mesh& mesh, const MeshPoints* points, const ExportMeshOptions& options) {
  check_mesh(mesh);
  const std::vector<Vec3f>& vertices = frame_points(mesh, points);
  const float scale = units_per_mm(options.unit);
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment Facegraph\nelement vertex ";
  append_count(out, vertices.size());
  out += "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!mesh.colors_srgb.empty()) out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  out += "element face ";
  append_count(out, mesh.polygon_count());
  out += "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    for (const float x : vertices[v]) append_raw(out, x * scale);
    if (!mesh.colors_srgb.empty())
      for (const float c : mesh.colors_srgb[v])
        append_raw(out, static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0f, 1.0f))));
  }
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p) {
    const std::size_t first = mesh.polygon_starts[p], end = mesh.polygon_starts[p + 1];
    check(end - first < 256, "polygon ", p, " has ", end - first, " corners, expected at most 255");
    append_raw(out, static_cast<std::uint8_t>(end - first));
    for (std::size_t c = first; c < end; ++c) append_raw(out, static_cast<std::int32_t>(mesh.corners[c]));
  }
  return engine::File::from_bytes(std::move(out), ".ply");
}

}  // namespace face::exports
