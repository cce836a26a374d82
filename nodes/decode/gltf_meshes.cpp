// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_meshes.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/decode/gltf_accessor.h"
#include "nodes/decode/gltf_file.h"
#include "nodes/decode/gltf_looks.h"
#include "nodes/decode/gltf_places.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

// Of a triangle that a transparent picture lies on, such as a lash or a strand of hair: what shows less is not drawn.
constexpr float least_cover = 0.5f;
class Collector {
 public:
  Collector(const tinygltf::Model& model, const std::string& title)
      : model_(model), title_(title), places_(gltf_places(model, title)), looks_(model, title) {}

  GltfMeshes collect() {
    std::vector<int> roots;
    if (!model_.scenes.empty()) {
      const int scene = std::clamp(model_.defaultScene, 0, static_cast<int>(model_.scenes.size()) - 1);
      roots = model_.scenes[static_cast<std::size_t>(scene)].nodes;
    } else {
      for (std::size_t i = 0; i < model_.nodes.size(); ++i) roots.push_back(static_cast<int>(i));
    }
    for (const int root : roots) visit(root);
    for (auto& offsets : raw_.shape_offsets) offsets.resize(raw_.points.size());
    return std::move(raw_);
  }

 private:
  void visit(int index) {
    check(index >= 0 && static_cast<std::size_t>(index) < model_.nodes.size(), title_, ": refers to node ", index,
          " of ", model_.nodes.size());
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
    if (node.mesh >= 0 && static_cast<std::size_t>(node.mesh) < model_.meshes.size())
      add_mesh(model_.meshes[static_cast<std::size_t>(node.mesh)], places_[static_cast<std::size_t>(index)], node.skin);
    for (const int child : node.children) visit(child);
  }

  void add_mesh(const tinygltf::Mesh& mesh, const GltfMatrix& place, int skin) {
    if (mesh.extras.IsObject() && mesh.extras.Has("facegraph")) raw_.notes = &mesh.extras.Get("facegraph");
    std::map<int, std::uint32_t> first_of;  // primitives may share their vertices
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end()) continue;
      const auto [first, added] =
          first_of.try_emplace(position->second, static_cast<std::uint32_t>(raw_.points.size()));
      if (added) add_vertices(mesh, primitive, position->second, place, skin);
      const std::size_t begin = raw_.triangles.size();
      add_triangles(primitive, first->second, static_cast<std::uint32_t>(raw_.points.size()), mesh);
      if (skin < 0 && mirrors(place))  // glTF 2.0, section 3.7.4
        for (std::size_t t = begin; t < raw_.triangles.size(); ++t)
          std::swap(raw_.triangles[t][1], raw_.triangles[t][2]);
    }
  }

  void add_vertices(const tinygltf::Mesh& mesh, const tinygltf::Primitive& primitive, int position,
                    const GltfMatrix& place, int skin) {
    const std::size_t first = raw_.points.size();
    const std::vector<float> points = read_floats(model_, position, 3, title_);
    const std::size_t count = points.size() / 3;
    const std::vector<GltfMatrix> places = skin >= 0 ? skin_places(model_, skin, primitive, places_, count, title_)
                                                     : std::vector<GltfMatrix>(count, place);
    for (std::size_t v = 0; v < count; ++v) raw_.points.push_back(apply(places[v], &points[v * 3], 1));
    raw_.uvs.resize(first + count);
    raw_.colors.resize(first + count, Vec3f{1, 1, 1});
    if (const auto uv = primitive.attributes.find("TEXCOORD_0"); uv != primitive.attributes.end()) {
      const std::vector<float> values = read_floats(model_, uv->second, 2, title_);
      expect_rows(values.size() / 2, count, "texture coordinates");
      for (std::size_t v = 0; v < count; ++v) raw_.uvs[first + v] = {values[v * 2], 1 - values[v * 2 + 1]};
      raw_.any_uvs = true;
    }
    if (const auto color = primitive.attributes.find("COLOR_0"); color != primitive.attributes.end()) {
      const auto accessor = static_cast<std::size_t>(std::max(color->second, 0));
      const int width =
          accessor < model_.accessors.size() && model_.accessors[accessor].type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
      const std::vector<float> values = read_floats(model_, color->second, width, title_);
      expect_rows(values.size() / static_cast<std::size_t>(width), count, "colours");
      for (std::size_t v = 0; v < count; ++v)
        for (std::size_t k = 0; k < 3; ++k)
          raw_.colors[first + v][k] = srgb(static_cast<double>(values[v * static_cast<std::size_t>(width) + k]));
      raw_.any_colors = true;
    }
    raw_.pictured.resize(first + count, Vec3f{1, 1, 1});
    for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
      const auto target = primitive.targets[t].find("POSITION");
      if (target == primitive.targets[t].end()) continue;
      const std::vector<float> values = read_floats(model_, target->second, 3, title_);
      const std::string name = gltf_target_name(model_, mesh, primitive, t);
      expect_rows(values.size() / 3, count, "offsets of shape " + name);
      std::vector<Vec3f>& offsets = offsets_of(name);
      offsets.resize(first + count);
      for (std::size_t v = 0; v < count; ++v) offsets[first + v] = apply(places[v], &values[v * 3], 0);
    }
  }

  // Colours the vertices of the triangles from `begin` on by the picture on them, and puts those triangles last of
  // which the picture shows less than half. Returns how many it leaves.
  std::size_t add_picture(const tinygltf::Primitive& primitive, std::uint32_t first, std::uint32_t end,
                          std::size_t begin) {
    const std::size_t all = raw_.triangles.size() - begin;
    const Image* picture = looks_.picture_on(primitive);
    const auto found = primitive.attributes.find(looks_.coordinates_of(primitive));
    if (picture == nullptr || found == primitive.attributes.end()) return all;
    const std::vector<float> values = read_floats(model_, found->second, 2, title_);
    expect_rows(values.size() / 2, end - first, "texture coordinates");
    const auto uv = [&](std::uint32_t v) { return Vec2f{values[2 * (v - first)], values[2 * (v - first) + 1]}; };
    const auto own = raw_.triangles.begin() + static_cast<std::ptrdiff_t>(begin);
    for (auto triangle = own; triangle != raw_.triangles.end(); ++triangle)
      for (const std::uint32_t v : *triangle) raw_.pictured[v] = colour_at(*picture, uv(v));
    raw_.any_pictured = true;
    const tinygltf::Material& material = model_.materials[static_cast<std::size_t>(primitive.material)];
    if (material.alphaMode == "OPAQUE") return all;
    const float cutoff = material.alphaMode == "MASK" ? static_cast<float>(material.alphaCutoff) : 0;
    const auto is_seen = [&](const std::array<std::uint32_t, 3>& triangle) {
      return cover_of(*picture, {uv(triangle[0]), uv(triangle[1]), uv(triangle[2])}, cutoff) >= least_cover;
    };
    return static_cast<std::size_t>(std::stable_partition(own, raw_.triangles.end(), is_seen) - own);
  }

  void expect_rows(std::size_t found, std::size_t count, const std::string& what) const {
    if (found != count) fail(title_, ": has ", found, " ", what, ", its mesh has ", count, " vertices");
  }

  std::vector<Vec3f>& offsets_of(const std::string& name) {
    for (std::size_t s = 0; s < raw_.shape_names.size(); ++s)
      if (raw_.shape_names[s] == name) return raw_.shape_offsets[s];
    raw_.shape_names.push_back(name);
    return raw_.shape_offsets.emplace_back();
  }

  void add_triangles(const tinygltf::Primitive& primitive, std::uint32_t first, std::uint32_t end,
                     const tinygltf::Mesh& mesh) {
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
      corners = read_indices(model_, primitive.indices, title_);
    } else {
      for (std::uint32_t v = first; v < end; ++v) corners.push_back(v - first);
    }
    for (std::uint32_t& v : corners) {
      if (v >= end - first) fail(title_, ": a triangle has vertex ", v, ", its mesh has ", end - first);
      v += first;
    }
    const auto begin = static_cast<std::uint32_t>(raw_.triangles.size());
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode == TINYGLTF_MODE_TRIANGLES)
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        raw_.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
      for (std::size_t i = 0; i + 2 < corners.size(); ++i)
        raw_.triangles.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        raw_.triangles.push_back({corners[0], corners[i], corners[i + 1]});
    const auto seen = static_cast<std::uint32_t>(add_picture(primitive, first, end, begin));
    Part part = part_of(primitive, mesh);
    const auto add_part = [&](std::uint32_t from, std::uint32_t to) {
      part.first_polygon = from;
      part.polygon_count = to - from;
      if (to > from) raw_.parts.push_back(part);
    };
    add_part(begin, begin + seen);
    part.visible = false;
    add_part(begin + seen, static_cast<std::uint32_t>(raw_.triangles.size()));
  }

  Part part_of(const tinygltf::Primitive& primitive, const tinygltf::Mesh& mesh) {
    Part part;
    part.name = lower(mesh.name);
    if (primitive.material < 0 || static_cast<std::size_t>(primitive.material) >= model_.materials.size()) return part;
    const tinygltf::Material& material = model_.materials[static_cast<std::size_t>(primitive.material)];
    // The mesh says what it is where it is teeth; else the material's name is the finer one.
    const bool teeth = part.name.find("teeth") != std::string::npos || part.name.find("tooth") != std::string::npos;
    if (!teeth && !material.name.empty()) part.name = lower(material.name);
    const auto& look = material.pbrMetallicRoughness;
    if ((look.baseColorTexture.index < 0 || looks_.picture_on(primitive)) && look.baseColorFactor.size() == 4)
      for (std::size_t k = 0; k < 3; ++k) part.albedo_srgb[k] = srgb(look.baseColorFactor[k]);
    part.gloss = std::clamp(static_cast<float>((0.8 - look.roughnessFactor) / 0.65), 0.0f, 1.0f);
    part.visible = material.alphaMode == "OPAQUE" || look.baseColorFactor.size() < 4 || look.baseColorFactor[3] > 0.3;
    return part;
  }

  const tinygltf::Model& model_;
  const std::string& title_;
  const std::vector<GltfMatrix> places_;  // of the nodes
  GltfLooks looks_;
  GltfMeshes raw_;
};

}  // namespace

GltfMeshes collect_meshes(const tinygltf::Model& model, const std::string& title) {
  return Collector(model, title).collect();
}

}  // namespace face::decode
