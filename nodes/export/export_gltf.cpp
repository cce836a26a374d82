// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/base/srgb.h"
#include "nodes/decode/glb.h"
#include "nodes/export/animate_original.h"
#include "nodes/export/gltf_animation.h"
#include "nodes/export/gltf_buffer.h"
#include "nodes/export/timed_frames.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/arkit.h"

namespace face::exports {
namespace {

using nlohmann::json;
using render::Triangle;
using render::Triangulation;

constexpr float m_per_mm = 0.001f;

// The vertices of the glTF mesh: the rig's V, then copies of those that have several texture coordinates.
struct Vertices {
  std::vector<std::uint32_t> copies;                  // rig vertex of vertex V + i
  std::vector<Vec2f> uvs;                             // all vertices; empty for a mesh without
  std::vector<std::vector<Triangle>> triangles;       // per part
  std::vector<std::vector<std::uint32_t>> copies_of;  // per rig vertex that has any; else empty. V, or empty

  std::vector<Vec3f> with_copies(std::vector<Vec3f> values) const {
    for (const std::uint32_t v : copies) values.push_back(values[v]);
    return values;
  }
};

// The vertex for a rig vertex with a texture coordinate: the rig's own for the first one, else a copy.
class SeamCutter {
 public:
  SeamCutter(const Mesh& mesh, Vertices& vertices) : mesh_(mesh), out_(vertices), first_(mesh.points_mm.size(), unset) {
    out_.uvs.assign(mesh.points_mm.size(), Vec2f{0, 0});
    out_.copies_of.resize(mesh.points_mm.size());
  }

  std::uint32_t vertex(std::uint32_t v, std::uint32_t uv) {
    if (first_[v] == unset) {
      first_[v] = uv;
      out_.uvs[v] = flipped(uv);
    }
    if (first_[v] == uv || mesh_.uvs[first_[v]] == mesh_.uvs[uv]) return v;
    const auto [place, added] = further_.try_emplace({v, uv}, 0);
    if (added) {
      place->second = static_cast<std::uint32_t>(out_.uvs.size());
      out_.uvs.push_back(flipped(uv));
      out_.copies.push_back(v);
      out_.copies_of[v].push_back(place->second);
    }
    return place->second;
  }

 private:
  static constexpr std::uint32_t unset = 0xffffffff;
  // glTF's origin is the top left, ours the bottom left.
  Vec2f flipped(std::uint32_t uv) const { return {mesh_.uvs[uv][0], 1.0f - mesh_.uvs[uv][1]}; }

  const Mesh& mesh_;
  Vertices& out_;
  std::vector<std::uint32_t> first_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> further_;
};

Vertices make_vertices(const Mesh& mesh) {
  Vertices vertices;
  const std::size_t parts = std::max<std::size_t>(1, mesh.parts.size());
  vertices.triangles.resize(parts);
  const Triangulation all = render::triangulate(mesh);  // also checks the polygons
  if (mesh.uvs.empty() || mesh.corner_uvs.empty()) {
    for (std::size_t t = 0; t < all.triangles.size(); ++t) vertices.triangles[all.parts[t]].push_back(all.triangles[t]);
    return vertices;
  }
  check(mesh.corner_uvs.size() == mesh.corners.size(), "the rig has ", mesh.corner_uvs.size(),
        " texture coordinates of corners, but ", mesh.corners.size(), " corners");
  for (const std::uint32_t uv : mesh.corner_uvs)
    check(uv < mesh.uvs.size(), "a corner has texture coordinate ", uv, " of ", mesh.uvs.size());
  SeamCutter cutter(mesh, vertices);
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    // The fan of triangulate(): the polygon's first corner and two neighbours.
    const std::uint32_t polygon = all.polygons[t];
    const std::uint32_t start = mesh.polygon_starts[polygon];
    const bool first_of_fan = t == 0 || all.polygons[t - 1] != polygon;
    std::uint32_t step = 1;
    if (!first_of_fan)
      for (std::size_t back = t; back > 0 && all.polygons[back - 1] == polygon; --back) ++step;
    const auto corner = [&](std::uint32_t c) { return cutter.vertex(mesh.corners[c], mesh.corner_uvs[c]); };
    vertices.triangles[all.parts[t]].push_back({corner(start), corner(start + step), corner(start + step + 1)});
  }
  return vertices;
}

std::vector<Vec3f> in_metres(std::vector<Vec3f> values_mm) {
  for (Vec3f& value : values_mm)
    for (float& axis : value) axis *= m_per_mm;
  return values_mm;
}

// A vertex that no triangle uses has no normal, but glTF wants unit length.
std::vector<Vec3f> unit_normals(std::vector<Vec3f> normals) {
  for (Vec3f& n : normals)
    if (n == Vec3f{0, 0, 0}) n = {0, 0, 1};
  return normals;
}

float linear(float srgb) { return static_cast<float>(linear_of(static_cast<double>(srgb))); }

json material_of(const Part& part) {
  const bool thin = part.name.find("lash") != std::string::npos;
  json material = {
      {"name", part.name},
      {"pbrMetallicRoughness",
       {{"baseColorFactor",
         {linear(part.albedo_srgb[0]), linear(part.albedo_srgb[1]), linear(part.albedo_srgb[2]), thin ? 0.5f : 1.0f}},
        {"metallicFactor", 0},
        {"roughnessFactor", std::clamp(0.8f - 0.65f * part.gloss, 0.05f, 1.0f)}}},
      {"doubleSided", true}};
  if (thin) material["alphaMode"] = "BLEND";
  return material;
}

// Changes of a shape over all glTF vertices, as ascending vertices and their values.
struct Changes {
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3f> values;

  void add_copies(const Vertices& all) {
    if (all.copies.empty()) return;
    std::vector<std::pair<std::uint32_t, Vec3f>> further;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (const std::uint32_t copy : all.copies_of[vertices[i]]) further.emplace_back(copy, values[i]);
    std::sort(further.begin(), further.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [vertex, value] : further) {
      vertices.push_back(vertex);
      values.push_back(value);
    }
  }
};

Changes position_changes(const Shape& shape, const Vertices& all) {
  Changes changes{shape.vertices, in_metres(shape.offsets_mm)};
  changes.add_copies(all);
  return changes;
}

// Only normals near the moved vertices change; smaller changes than a viewer can show are left out.
Changes normal_changes(const Rig& rig, const Shape& shape, const std::vector<Triangle>& triangles,
                       const std::vector<Vec3f>& neutral_normals, const Vertices& all) {
  std::vector<Vec3f> points = rig.neutral.points_mm;
  add_shape(shape, 1, points);
  const std::vector<Vec3f> normals = unit_normals(render::vertex_normals(points, triangles));
  Changes changes;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    Vec3f change;
    float largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      change[axis] = normals[v][axis] - neutral_normals[v][axis];
      largest = std::max(largest, std::abs(change[axis]));
    }
    if (largest < 0.01f) continue;
    changes.vertices.push_back(static_cast<std::uint32_t>(v));
    changes.values.push_back(change);
  }
  changes.add_copies(all);
  return changes;
}

json targets_of(const Rig& rig, const Vertices& all, const ExportGltfOptions& options, GltfBuffer& buffer) {
  const std::size_t count = rig.neutral.points_mm.size() + all.copies.size();
  const std::vector<Triangle> triangles = render::triangulate(rig.neutral).triangles;
  const std::vector<Vec3f> neutral_normals = unit_normals(render::vertex_normals(rig.neutral.points_mm, triangles));
  int zeros = -1;  // shared by all that change nothing
  const auto add = [&](const Changes& changes) {
    if (!changes.vertices.empty()) return buffer.add_sparse_vectors(count, changes.vertices, changes.values);
    if (zeros < 0) zeros = buffer.add_sparse_vectors(count, {}, {});
    return zeros;
  };
  json targets = json::array();
  for (const Shape& shape : rig.shapes) {
    check(shape.vertices.size() == shape.offsets_mm.size(), "shape \"", shape.name, "\" has ", shape.vertices.size(),
          " vertices, but ", shape.offsets_mm.size(), " offsets");
    check(shape.vertices.empty() || shape.vertices.back() < rig.neutral.points_mm.size(), "shape \"", shape.name,
          "\" moves vertex ", shape.vertices.empty() ? 0 : shape.vertices.back(), " of ", rig.neutral.points_mm.size());
    json target = {{"POSITION", add(position_changes(shape, all))}};
    if (options.morph_normals) {
      const Changes normals =
          shape.vertices.empty() ? Changes{} : normal_changes(rig, shape, triangles, neutral_normals, all);
      target["NORMAL"] = add(normals);
    }
    targets.push_back(std::move(target));
  }
  return targets;
}

// Where vertices are, at rest and with the jaw open (lips that meet are at one place at rest), in hundredths of a
// millimetre: a program that changes the file numbers them anew.
json places_of(const Rig& rig, const std::vector<Vec3f>& jaw_mm, const std::vector<std::uint32_t>& vertices) {
  json places = json::array();
  for (const std::uint32_t v : vertices) {
    for (std::size_t c = 0; c < 3; ++c) places.push_back(std::lround(100 * rig.neutral.points_mm[v][c]));
    for (std::size_t c = 0; c < 3; ++c) places.push_back(std::lround(100 * jaw_mm[v][c]));
  }
  return places;
}

json annotations_of(const Rig& rig, const Vertices& all, json parts) {
  json pairs = json::array();
  std::vector<std::uint32_t> lips;
  for (const LipPair& pair : rig.inner_lips) {
    pairs.push_back({pair.upper, pair.lower});
    lips.insert(lips.end(), {pair.upper, pair.lower});
  }
  std::vector<Vec3f> jaw_mm = rig.neutral.points_mm;
  const Shape jaw = rig.shapes.size() > arkit_index("jawOpen") ? rig.shapes[arkit_index("jawOpen")] : Shape();
  for (std::size_t i = 0; i < jaw.vertices.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) jaw_mm[jaw.vertices[i]][c] += jaw.offsets_mm[i][c];
  return {{"version", 1},
          {"places",
           {{"inner_lips", places_of(rig, jaw_mm, lips)},
            {"lower_lip", places_of(rig, jaw_mm, rig.lower_lip)},
            {"upper_teeth", places_of(rig, jaw_mm, rig.upper_teeth)},
            {"landmarks68", places_of(rig, jaw_mm, rig.landmarks68)}}},
          {"vertex_count", rig.neutral.points_mm.size()},
          {"copies", all.copies},
          {"parts", std::move(parts)},
          {"inner_lips", std::move(pairs)},
          {"lower_lip", rig.lower_lip},
          {"upper_teeth", rig.upper_teeth},
          {"landmarks68", rig.landmarks68},
          {"missing", rig.missing}};
}

}  // namespace

engine::File export_gltf(const Rig& rig, const engine::Seq<Weights>& frames, const Timeline& timeline,
                         const engine::File* original, const engine::File* names, const ExportGltfOptions& options) {
  check_frames(frames.size(), timeline);
  check(!rig.shapes.empty(), "the rig has no shapes, so there is nothing to animate");
  if (original) {
    const decode::ShapeNames known = names ? decode::read_shape_names(*names) : decode::ShapeNames{};
    if (std::optional<engine::File> kept = animate_original(*original, known, rig, frames, timeline)) return *kept;
  }
  const Mesh& mesh = rig.neutral;
  check(mesh.colors_srgb.empty() || mesh.colors_srgb.size() == mesh.points_mm.size(), "the rig has ",
        mesh.colors_srgb.size(), " vertex colours, but ", mesh.points_mm.size(), " vertices");
  const Vertices vertices = make_vertices(mesh);
  GltfBuffer buffer;

  json attributes = {{"POSITION", buffer.add_vectors(vertices.with_copies(in_metres(mesh.points_mm)), true)}};
  const std::vector<Triangle> all_triangles = render::triangulate(mesh).triangles;
  attributes["NORMAL"] = buffer.add_vectors(
      vertices.with_copies(unit_normals(render::vertex_normals(mesh.points_mm, all_triangles))), false);
  if (!vertices.uvs.empty()) attributes["TEXCOORD_0"] = buffer.add_vectors(vertices.uvs);
  if (!mesh.colors_srgb.empty()) {
    std::vector<Vec3f> colors = mesh.colors_srgb;
    for (Vec3f& color : colors)
      for (float& channel : color) channel = linear(std::clamp(channel, 0.0f, 1.0f));
    attributes["COLOR_0"] = buffer.add_vectors(vertices.with_copies(std::move(colors)), false);
  }
  const json targets = targets_of(rig, vertices, options, buffer);

  json primitives = json::array(), materials = json::array(), parts = json::array();
  for (std::size_t p = 0; p < vertices.triangles.size(); ++p) {
    if (vertices.triangles[p].empty()) continue;
    Part whole;
    whole.name = "head";
    const Part& part = mesh.parts.empty() ? whole : mesh.parts[p];
    std::vector<std::uint32_t> indices;
    indices.reserve(vertices.triangles[p].size() * 3);
    for (const Triangle& triangle : vertices.triangles[p])
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    primitives.push_back({{"attributes", attributes},
                          {"indices", buffer.add_indices(indices)},
                          {"material", materials.size()},
                          {"targets", targets}});
    materials.push_back(material_of(part));
    parts.push_back({{"name", part.name}, {"gloss", part.gloss}});
  }
  check(!primitives.empty(), "the rig has no visible polygon to export");
  json shape_names = json::array();
  for (const Shape& shape : rig.shapes) shape_names.push_back(shape.name);

  json document = {
      {"asset", {{"version", "2.0"}, {"generator", "Facegraph"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"name", "head"}, {"mesh", 0}}}},
      {"meshes",
       {{{"name", "head"},
         {"primitives", std::move(primitives)},
         {"weights", std::vector<float>(rig.shapes.size(), 0.0f)},
         {"extras",
          {{"targetNames", std::move(shape_names)}, {"facegraph", annotations_of(rig, vertices, std::move(parts))}}}}}},
      {"materials", std::move(materials)}};
  document["animations"] = json::array({animation_of({{0, weight_rows(rig, frames)}}, timeline, buffer)});
  document["accessors"] = std::move(buffer.accessors);
  document["bufferViews"] = std::move(buffer.views);
  return engine::File::from_bytes(decode::glb_bytes(std::move(document), std::move(buffer.bytes)), ".glb");
}

}  // namespace face::exports
