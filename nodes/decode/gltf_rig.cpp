// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_rig.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>

#include "nodes/base/check.h"
#include "nodes/base/srgb.h"
#include "nodes/decode/gltf_accessor.h"
#include "nodes/decode/gltf_file.h"
#include "nodes/decode/gltf_looks.h"
#include "nodes/decode/gltf_places.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/mouth_marks.h"
#include "nodes/types/arkit.h"

namespace face::decode {
namespace {

// Of a triangle that a transparent picture lies on, such as a lash or a strand of hair: what shows less is not drawn.
constexpr float least_cover = 0.5f;

float srgb(double linear) { return static_cast<float>(srgb_of(std::clamp(linear, 0.0, 1.0))); }

// The file's vertices as they are, before those that texture seams doubled are merged.
struct Raw {
  std::vector<Vec3f> points;
  std::vector<Vec2f> uvs;
  std::vector<Vec3f> colors;
  std::vector<Vec3f> pictured;  // the texture's colour there; a primitive may colour vertices of another's list
  bool any_uvs = false, any_colors = false, any_pictured = false;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Part> parts;
  std::vector<std::string> shape_names;           // in order of appearance
  std::vector<std::vector<Vec3f>> shape_offsets;  // of each: one per vertex so far
  const tinygltf::Value* notes = nullptr;         // extras.facegraph
};

class Collector {
 public:
  Collector(const tinygltf::Model& model, const std::string& title)
      : model_(model), title_(title), places_(gltf_places(model, title)), looks_(model, title) {}

  Raw collect() {
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
  Raw raw_;
};

std::vector<std::uint32_t> note_indices(const tinygltf::Value& notes, const char* key, std::size_t limit,
                                        const std::string& title) {
  std::vector<std::uint32_t> out;
  if (!notes.IsObject() || !notes.Has(key) || !notes.Get(key).IsArray()) return out;
  const tinygltf::Value& list = notes.Get(key);
  const auto add = [&](const tinygltf::Value& value) {
    const double index = value.IsNumber() ? value.GetNumberAsDouble() : -1;
    if (index < 0 || index >= static_cast<double>(limit))
      fail(title, " at extras.facegraph.", key, ": found vertex ", index, ", expected one of 0 to ", limit - 1);
    out.push_back(static_cast<std::uint32_t>(index));
  };
  for (int i = 0; i < static_cast<int>(list.ArrayLen()); ++i) {
    const tinygltf::Value& row = list.Get(i);
    if (!row.IsArray()) {
      add(row);
      continue;
    }
    for (int k = 0; k < static_cast<int>(row.ArrayLen()); ++k) add(row.Get(k));
  }
  return out;
}

// For every vertex of the file, the vertex of the rig. Our own files say which are copies; in others, vertices at one
// place that all shapes move alike are one.
std::vector<std::uint32_t> merge(const Raw& raw, const std::string& title, std::size_t& count) {
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
std::vector<Vec3f> seen_colors(const Raw& raw) {
  if (!raw.any_pictured) return raw.colors;
  std::vector<Vec3f> out = raw.pictured;
  for (std::size_t v = 0; v < out.size() && raw.any_colors; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      out[v][k] = srgb(linear_of(static_cast<double>(out[v][k])) * linear_of(static_cast<double>(raw.colors[v][k])));
  return out;
}

// A vertex at rest and with the jaw open, mm: two lips that meet at rest are two.
using Place = std::array<float, 6>;

std::vector<Place> places_of(const Rig& rig) {
  std::vector<Place> places;
  for (const Vec3f& p : rig.neutral.points_mm) places.push_back({p[0], p[1], p[2], p[0], p[1], p[2]});
  const Shape& jaw = rig.shapes[arkit_index("jawOpen")];
  for (std::size_t i = 0; i < jaw.vertices.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) places[jaw.vertices[i]][3 + c] += jaw.offsets_mm[i][c];
  return places;
}

float distance(const Place& a, const Place& b) {
  float squared = 0;
  for (std::size_t c = 0; c < a.size(); ++c) squared += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(squared);
}

// Noted vertices as they are numbered now: a program that changed the file may have numbered them anew. None where one
// of them is no more.
std::vector<std::uint32_t> noted_vertices(const tinygltf::Value& notes, const char* key, const std::string& title,
                                          const std::vector<Place>& places) {
  constexpr float same_mm = 0.05f, moved_mm = 1;
  const tinygltf::Value noted = notes.Has("places") ? notes.Get("places") : tinygltf::Value();
  if (!noted.IsObject() || !noted.Has(key)) return note_indices(notes, key, places.size(), title);
  const tinygltf::Value& list = noted.Get(key);
  std::vector<std::uint32_t> vertices = note_indices(notes, key, std::numeric_limits<std::uint32_t>::max(), title);
  if (!list.IsArray() || list.ArrayLen() != std::tuple_size_v<Place> * vertices.size()) return {};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Place place;
    for (std::size_t c = 0; c < place.size(); ++c)
      place[c] = static_cast<float>(list.Get(static_cast<int>(place.size() * i + c)).GetNumberAsDouble() / 100);
    if (vertices[i] < places.size() && distance(places[vertices[i]], place) < same_mm) continue;
    std::size_t nearest = 0;
    for (std::size_t v = 0; v < places.size(); ++v)
      if (distance(places[v], place) < distance(places[nearest], place)) nearest = v;
    if (distance(places[nearest], place) > moved_mm) return {};
    vertices[i] = static_cast<std::uint32_t>(nearest);
  }
  return vertices;
}

void read_notes(const tinygltf::Value& notes, const std::string& title, Rig& rig) {
  const std::vector<Place> places = places_of(rig);
  const auto marked = [&](const char* key) { return noted_vertices(notes, key, title, places); };
  const std::vector<std::uint32_t> pairs = marked("inner_lips");
  check(pairs.size() % 2 == 0, title, " at extras.facegraph.inner_lips: found ", pairs.size(),
        " vertices, expected pairs");
  for (std::size_t i = 0; i < pairs.size(); i += 2) rig.inner_lips.push_back({pairs[i], pairs[i + 1]});
  rig.lower_lip = marked("lower_lip");
  rig.upper_teeth = marked("upper_teeth");
  rig.landmarks68 = marked("landmarks68");
  if (notes.Has("parts") && notes.Get("parts").ArrayLen() == rig.neutral.parts.size())
    for (std::size_t i = 0; i < rig.neutral.parts.size(); ++i) {
      const tinygltf::Value& part = notes.Get("parts").Get(static_cast<int>(i));
      if (!part.IsObject()) continue;
      if (part.Has("name") && part.Get("name").IsString())
        rig.neutral.parts[i].name = part.Get("name").Get<std::string>();
      if (part.Has("gloss") && part.Get("gloss").IsNumber())
        rig.neutral.parts[i].gloss = static_cast<float>(part.Get("gloss").GetNumberAsDouble());
      rig.neutral.parts[i].visible = true;  // the exporter leaves the others out
    }
  if (!notes.Has("missing") || !notes.Get("missing").IsArray()) return;
  rig.missing.clear();
  for (int i = 0; i < static_cast<int>(notes.Get("missing").ArrayLen()); ++i)
    if (notes.Get("missing").Get(i).IsString()) rig.missing.push_back(notes.Get("missing").Get(i).Get<std::string>());
}

}  // namespace

Rig read_gltf_rig(const engine::File& file, const ShapeNames& names, LengthUnit unit) {
  const engine::File main = gltf_main_file(file);
  return rig_of_gltf(load_gltf(file, main), title_of(main), names, unit);
}

Rig rig_of_gltf(const tinygltf::Model& model, const std::string& title, const ShapeNames& names, LengthUnit unit) {
  const Raw raw = Collector(model, title).collect();
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
