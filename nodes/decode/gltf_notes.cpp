// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_notes.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::decode {
namespace {

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

}  // namespace

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

}  // namespace face::decode
