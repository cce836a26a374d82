// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_mesh.h"

#include <string>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/obj.h"
#include "nodes/decode/ply.h"

namespace face::decode {
namespace {

Mesh mesh_of(Ply&& ply) {
  Mesh mesh;
  mesh.points_mm = std::move(ply.points);
  mesh.colors_srgb = std::move(ply.colors_srgb);
  mesh.corners = std::move(ply.corners);
  mesh.polygon_starts = std::move(ply.polygon_starts);
  return mesh;
}

Mesh mesh_of(Obj&& obj) {
  Mesh mesh;
  mesh.points_mm = std::move(obj.points);
  mesh.uvs = std::move(obj.uvs);
  mesh.corners = std::move(obj.corners);
  mesh.corner_uvs = std::move(obj.corner_uvs);
  mesh.polygon_starts = std::move(obj.polygon_starts);
  if (mesh.corner_uvs.empty()) mesh.uvs.clear();
  const auto polygons = static_cast<std::uint32_t>(mesh.polygon_count());
  const auto add_part = [&](const std::string& name, std::uint32_t first, std::uint32_t end) {
    if (end > first) mesh.parts.push_back({.name = name, .first_polygon = first, .polygon_count = end - first});
  };
  if (!obj.materials.empty()) add_part("mesh", 0, obj.materials[0].first_polygon);
  for (std::size_t m = 0; m < obj.materials.size(); ++m)
    add_part(obj.materials[m].name, obj.materials[m].first_polygon,
             m + 1 < obj.materials.size() ? obj.materials[m + 1].first_polygon : polygons);
  return mesh;
}

// What to do about a file of another kind.
std::string remedy(const std::string& suffix) {
  if (suffix == ".fbx" || suffix == ".abc" || suffix == ".usd" || suffix == ".usdc" || suffix == ".usda" ||
      suffix == ".blend" || suffix == ".dae" || suffix == ".3ds" || suffix == ".stl" || suffix == ".off" ||
      suffix == ".wrl")
    return "; open it in Blender and export PLY or OBJ";
  if (suffix == ".glb" || suffix == ".gltf" || suffix == ".vrm")
    return "; decode.rig reads heads with morph targets, decode.rig_mesh their mesh";
  if (suffix == ".npy" || suffix == ".pc2") return "; decode.points reads the vertices of an animation";
  if (suffix == ".pkl" || suffix == ".npz")
    return "; Python's pickles are programs and are not opened: save the vertices with numpy.save and use "
           "decode.points";
  return "";
}

}  // namespace

ReadMeshResult read_mesh(const engine::File& file, const ReadMeshOptions& options) {
  const std::string title = title_of(file), suffix = lower_suffix(file), bytes = read_bytes(file);
  check(!bytes.empty(), title, ": is empty (0 bytes), expected PLY or OBJ");
  Mesh mesh;
  if (suffix == ".ply" || bytes.starts_with("ply\n") || bytes.starts_with("ply\r"))
    mesh = mesh_of(read_ply(bytes, title));
  else if (suffix == ".obj")
    mesh = mesh_of(read_obj(bytes, title));
  else
    fail(title, ": found the suffix \"", file.suffix(), "\", expected PLY or OBJ", remedy(suffix));
  check(!mesh.points_mm.empty(), title, ": found no vertices");
  const float scale = mm_per_unit(options.unit, mesh.points_mm);
  for (Vec3f& point : mesh.points_mm)
    for (float& x : point) x *= scale;
  MeshPoints points{mesh.points_mm};
  return {std::move(mesh), std::move(points)};
}

Mesh rig_mesh(const Rig& rig) { return rig.neutral; }

}  // namespace face::decode
