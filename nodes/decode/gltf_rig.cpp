// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_rig.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

#include "nodes/base/check.h"
#include "nodes/base/srgb.h"
#include "nodes/decode/gltf_file.h"
#include "nodes/decode/gltf_meshes.h"
#include "nodes/decode/gltf_notes.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/mouth_marks.h"

namespace face::decode {
namespace {

// For every vertex of the file, the vertex of the rig. Our own files say which are copies; in others, vertices at one
// place that all shapes move alike are one.
std::vector<std::uint32_t> merge(const GltfMeshes& raw, const std::string& title, std::size_t& count) {
  std::vector<std::uint32_t> to(raw.points.size());
  if (raw.notes && raw.notes->Has("vertex_count") && raw.notes->Get("vertex_count").IsNumber()) {
    const double stated = raw.notes->Get("vertex_count").GetNumberAsDouble();
    const std::size_t own =
        stated > 0 && stated <= static_cast<double>(to.size()) ? static_cast<std::size_t>(stated) : 0;
    const std::vector<std::uint32_t> copies =
        own > 0 ? note_indices(*raw.notes, "copies", own, title) : std::vector<std::uint32_t>();
    if (own > 0 && own + copies.size() == to.size()) {
      for (std::size_t v = 0; v < to.size(); ++v) to[v] = v < own ? static_cast<std::uint32_t>(v) : copies[v - own];
      count = own;
      return to;
    }
  }
  const auto alike = [&](std::uint32_t a, std::uint32_t b) {
    if (raw.colors[a] != raw.colors[b]) return false;
    for (const auto& offsets : raw.shape_offsets)
      if (offsets[a] != offsets[b]) return false;
    return true;
  };
  std::map<Vec3f, std::vector<std::uint32_t>> at_place;
  count = 0;
  for (std::uint32_t v = 0; v < to.size(); ++v) {
    std::vector<std::uint32_t>& here = at_place[raw.points[v]];
    const auto same = std::find_if(here.begin(), here.end(), [&](std::uint32_t other) { return alike(other, v); });
    if (same != here.end()) {
      to[v] = to[*same];
    } else {
      to[v] = static_cast<std::uint32_t>(count++);
      here.push_back(v);
    }
  }
  return to;
}

template <class T>
std::vector<T> gather(const std::vector<T>& raw, const std::vector<std::uint32_t>& to, std::size_t count) {
  std::vector<T> out(count);
  for (std::size_t v = raw.size(); v-- > 0;) out[to[v]] = raw[v];  // the first of several wins
  return out;
}

// Of every vertex, its own and the texture's together.
std::vector<Vec3f> seen_colors(const GltfMeshes& raw) {
  if (!raw.any_pictured) return raw.colors;
  std::vector<Vec3f> out = raw.pictured;
  for (std::size_t v = 0; v < out.size() && raw.any_colors; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      out[v][k] = srgb(linear_of(static_cast<double>(out[v][k])) * linear_of(static_cast<double>(raw.colors[v][k])));
  return out;
}

}  // namespace

Rig read_gltf_rig(const engine::File& file, const ShapeNames& names, LengthUnit unit) {
  const engine::File main = gltf_main_file(file);
  return rig_of_gltf(load_gltf(file, main), title_of(main), names, unit);
}

Rig rig_of_gltf(const tinygltf::Model& model, const std::string& title, const ShapeNames& names, LengthUnit unit) {
  const GltfMeshes raw = collect_meshes(model, title);
  if (raw.triangles.empty()) fail(title, ": is not a rig: found no mesh in its scene, expected one with morph targets");
  if (raw.shape_names.empty())
    fail(title, ": is not a rig: found a mesh of ", raw.points.size(), " vertices without morph targets");

  std::size_t count = 0;
  const std::vector<std::uint32_t> to = merge(raw, title, count);
  const float scale = mm_per_unit(unit, raw.points);
  const auto in_mm = [&](const std::vector<Vec3f>& values) {
    std::vector<Vec3f> out = gather(values, to, count);
    for (Vec3f& value : out)
      for (float& x : value) x *= scale;
    return out;
  };
  Rig rig;
  Mesh& mesh = rig.neutral;
  mesh.points_mm = in_mm(raw.points);
  if (raw.any_uvs) mesh.uvs = raw.uvs;
  if (raw.any_colors || raw.any_pictured) mesh.colors_srgb = gather(seen_colors(raw), to, count);
  mesh.parts = raw.parts;
  mesh.polygon_starts.push_back(0);
  for (const auto& triangle : raw.triangles) {
    for (const std::uint32_t v : triangle) {
      mesh.corners.push_back(to[v]);
      if (raw.any_uvs) mesh.corner_uvs.push_back(v);
    }
    mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  ShapeCollector shapes(names);
  for (std::size_t s = 0; s < raw.shape_names.size(); ++s) shapes.add(raw.shape_names[s], in_mm(raw.shape_offsets[s]));
  shapes.finish(title, rig);
  if (raw.notes) read_notes(*raw.notes, title, rig);
  find_mouth_marks(rig);
  return rig;
}

}  // namespace face::decode
