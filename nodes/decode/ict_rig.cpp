// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/ict_rig.h"

#include <algorithm>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/decode/ict_layout.h"
#include "nodes/decode/ict_look.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/mouth_marks.h"
#include "nodes/decode/obj.h"
#include "nodes/decode/rig_shapes.h"

namespace face::decode {
namespace {

constexpr std::string_view neutral_names[] = {"generic_neutral_mesh.obj", "neutral.obj"};

std::string_view leaf(std::string_view name) { return name.substr(name.find_last_of('/') + 1); }
std::string_view folder_of(std::string_view name) { return name.substr(0, name.size() - leaf(name).size()); }

const engine::File::Entry* find_neutral(const engine::File& folder) {
  for (const std::string_view wanted : neutral_names)
    for (const engine::File::Entry& entry : folder.entries())
      if (lower(std::string(leaf(entry.name))) == wanted) return &entry;
  return nullptr;
}

bool is_shape_file(std::string_view name, std::string_view neutral) {
  if (name == neutral || folder_of(name) != folder_of(neutral)) return false;
  const std::string_view file = leaf(name);
  return file.ends_with(".obj") && !file.starts_with("identity");
}

std::vector<Part> plain_parts(const Obj& obj) {
  std::vector<Part> parts;
  const auto polygons = static_cast<std::uint32_t>(obj.polygon_starts.size() - 1);
  if (obj.materials.empty() || obj.materials.front().first_polygon > 0)
    parts.push_back({.name = "face", .first_polygon = 0, .polygon_count = polygons});
  for (const ObjMaterial& material : obj.materials)
    parts.push_back({.name = lower(material.name), .first_polygon = material.first_polygon, .polygon_count = 0});
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i].polygon_count = (i + 1 < parts.size() ? parts[i + 1].first_polygon : polygons) - parts[i].first_polygon;
  std::erase_if(parts, [](const Part& part) { return part.polygon_count == 0; });
  return parts;
}

}  // namespace

bool is_obj_rig(const engine::File& folder) { return find_neutral(folder) != nullptr; }

const engine::File::Entry& obj_rig_neutral(const engine::File& folder) {
  const engine::File::Entry* neutral = find_neutral(folder);
  check(neutral != nullptr, title_of(folder), ": holds no ", neutral_names[0]);
  return *neutral;
}

Rig read_obj_rig(const engine::File& folder, const ShapeNames& names, LengthUnit unit) {
  const engine::File::Entry* neutral = &obj_rig_neutral(folder);
  const Obj obj = read_obj(read_bytes_at(neutral->path, neutral->name), neutral->name);
  if (obj.points.empty() || obj.corners.empty())
    fail(neutral->name, ": has ", obj.points.size(), " vertices and ", obj.polygon_starts.size() - 1,
         " polygons, expected a mesh");
  const float scale = mm_per_unit(unit, obj.points);

  Rig rig;
  Mesh& mesh = rig.neutral;
  mesh.points_mm = obj.points;
  for (Vec3f& p : mesh.points_mm)
    for (float& x : p) x *= scale;
  mesh.corners = obj.corners;
  mesh.polygon_starts = obj.polygon_starts;
  mesh.corner_uvs = obj.corner_uvs;
  if (!obj.corner_uvs.empty()) mesh.uvs = obj.uvs;

  ShapeCollector shapes(names);
  std::vector<Vec3f> offsets(obj.points.size());
  for (const engine::File::Entry& entry : folder.entries()) {
    if (!is_shape_file(entry.name, neutral->name)) continue;
    const Obj shape = read_obj(read_bytes_at(entry.path, entry.name), entry.name);
    if (shape.points.size() != obj.points.size())
      fail(entry.name, ": has ", shape.points.size(), " vertices, the neutral mesh ", neutral->name, " has ",
           obj.points.size());
    for (std::size_t v = 0; v < offsets.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k) offsets[v][k] = (shape.points[v][k] - obj.points[v][k]) * scale;
    const std::string_view file = leaf(entry.name);
    shapes.add(file.substr(0, file.size() - 4), offsets);
  }
  shapes.finish(title_of(folder), rig);

  if (obj.points.size() == ict_vertex_count) {
    dress_ict_mesh(obj, mesh);
    rig.landmarks68.assign(ict_landmarks68.begin(), ict_landmarks68.end());
    // Inner lip, upper and lower, right to left (Multi-PIE points 61-67, 62-66, 63-65, counted from 0).
    for (const auto& [upper, lower] : {std::pair{61, 67}, std::pair{62, 66}, std::pair{63, 65}})
      rig.inner_lips.push_back({ict_landmarks68[upper], ict_landmarks68[lower]});
  } else {
    mesh.parts = plain_parts(obj);
  }
  find_mouth_marks(rig);
  return rig;
}

}  // namespace face::decode
