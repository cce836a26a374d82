// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/animate_original.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "nodes/decode/glb.h"
#include "nodes/decode/gltf_file.h"
#include "nodes/export/gltf_animation.h"

namespace face::exports {
namespace {

using nlohmann::json;

// The JSON of a GLB, and its binary chunk.
struct Glb {
  json document;
  std::string binary;
};

// A channel for every node whose mesh has morph targets.
std::vector<WeightChannel> channels_of(const tinygltf::Model& model, const decode::ShapeNames& names, const Rig& rig,
                                       const std::vector<float>& rows) {
  std::map<std::string, std::size_t> shape_of;
  for (std::size_t s = 0; s < rig.shapes.size(); ++s) shape_of.emplace(rig.shapes[s].name, s);
  std::vector<WeightChannel> channels;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const int index = model.nodes[n].mesh;
    if (index < 0 || static_cast<std::size_t>(index) >= model.meshes.size()) continue;
    const tinygltf::Mesh& mesh = model.meshes[static_cast<std::size_t>(index)];
    if (mesh.primitives.empty() || mesh.primitives[0].targets.empty()) continue;
    std::vector<std::size_t> shapes;  // of each target; one that the rig does not have is behind its last
    for (std::size_t t = 0; t < mesh.primitives[0].targets.size(); ++t) {
      const std::string name = names.in_rig(decode::gltf_target_name(model, mesh, mesh.primitives[0], t));
      const auto shape = shape_of.find(name);
      shapes.push_back(shape == shape_of.end() ? rig.shapes.size() : shape->second);
    }
    WeightChannel channel{static_cast<int>(n), {}};
    for (std::size_t row = 0; row < rows.size(); row += rig.shapes.size())
      for (const std::size_t shape : shapes)
        channel.values.push_back(shape == rig.shapes.size() ? 0.0f : rows[row + shape]);
    channels.push_back(std::move(channel));
  }
  return channels;
}

// Leaves the animations without what moves the same weights.
json without_channels(const json& animations, const std::vector<WeightChannel>& channels) {
  json kept = json::array();
  for (json animation : animations) {
    json left = json::array();
    for (const json& channel : animation.value("channels", json::array())) {
      const json target = channel.value("target", json::object());
      const bool ours = target.value("path", "") == "weights" &&
                        std::any_of(channels.begin(), channels.end(),
                                    [&](const WeightChannel& c) { return target.value("node", -1) == c.node; });
      if (!ours) left.push_back(channel);
    }
    if (left.empty()) continue;
    animation["channels"] = std::move(left);
    kept.push_back(std::move(animation));
  }
  return kept;
}

// The accessors that animations read.
std::set<std::size_t> accessors_of(const json& animations) {
  std::set<std::size_t> accessors;
  for (const json& animation : animations)
    for (const json& sampler : animation.value("samplers", json::array()))
      for (const char* end : {"input", "output"})
        if (sampler.contains(end)) accessors.insert(sampler[end].get<std::size_t>());
  return accessors;
}

// The accessors that animations have read, and that nothing reads where these are left of them.
std::set<std::size_t> unread(const json& before, const json& left, const json& document) {
  std::set<std::size_t> accessors = accessors_of(before);
  for (const std::size_t read : accessors_of(left)) accessors.erase(read);
  const auto keep = [&](const json& index) {
    if (index.is_number_unsigned()) accessors.erase(index.get<std::size_t>());
  };
  for (const json& mesh : document.value("meshes", json::array()))
    for (const json& primitive : mesh.value("primitives", json::array())) {
      keep(primitive.value("indices", json()));
      for (const json& index : primitive.value("attributes", json::object())) keep(index);
      for (const json& target : primitive.value("targets", json::array()))
        for (const json& index : target) keep(index);
    }
  for (const json& skin : document.value("skins", json::array())) keep(skin.value("inverseBindMatrices", json()));
  return accessors;
}

// Takes out what only animations have read that are gone, where it lies at the end, as what was appended does: a head
// that is animated again and again does not grow.
void drop_last(const std::set<std::size_t>& gone, Glb& glb) {
  json &accessors = glb.document["accessors"], &views = glb.document["bufferViews"];
  std::set<std::size_t> views_gone;
  while (!accessors.empty() && gone.contains(accessors.size() - 1) && !accessors.back().contains("sparse")) {
    if (accessors.back().contains("bufferView")) views_gone.insert(accessors.back()["bufferView"].get<std::size_t>());
    accessors.erase(accessors.size() - 1);
  }
  const auto keep = [&](const json& reader) {
    if (reader.is_object() && reader.contains("bufferView")) views_gone.erase(reader["bufferView"].get<std::size_t>());
  };
  for (const json& accessor : accessors) {
    keep(accessor);
    const json sparse = accessor.value("sparse", json::object());
    keep(sparse.value("indices", json())), keep(sparse.value("values", json()));
  }
  for (const json& image : glb.document.value("images", json::array())) keep(image);
  while (!views.empty() && views_gone.contains(views.size() - 1)) {
    const auto begin_of = [](const json& view) { return view.value("byteOffset", std::size_t{0}); };
    const auto end_of = [&](const json& view) { return begin_of(view) + view.value("byteLength", std::size_t{0}); };
    const json last = views.back();
    constexpr std::size_t most_padding = 3;
    const bool at_end = end_of(last) <= glb.binary.size() && end_of(last) + most_padding >= glb.binary.size();
    views.erase(views.size() - 1);
    if (at_end && std::all_of(views.begin(), views.end(), [&](const json& v) { return end_of(v) <= begin_of(last); }))
      glb.binary.resize(begin_of(last));
  }
}

// Puts the new accessors behind those of the file.
void append(GltfBuffer buffer, json& animation, Glb& glb) {
  json& document = glb.document;
  const std::size_t views = document["bufferViews"].size(), accessors = document["accessors"].size();
  decode::pad(glb.binary);
  for (json& view : buffer.views) {
    view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + glb.binary.size();
    document["bufferViews"].push_back(std::move(view));
  }
  for (json& accessor : buffer.accessors) {
    accessor["bufferView"] = accessor["bufferView"].get<std::size_t>() + views;
    document["accessors"].push_back(std::move(accessor));
  }
  for (json& sampler : animation["samplers"])
    for (const char* end : {"input", "output"}) sampler[end] = sampler[end].get<std::size_t>() + accessors;
  glb.binary += buffer.bytes;
}

}  // namespace

std::optional<engine::File> animate_original(const engine::File& original, const decode::ShapeNames& names,
                                             const Rig& rig, const engine::Seq<Weights>& frames,
                                             const Timeline& timeline) {
  Glb glb;
  if (!decode::read_glb(original, glb.document, glb.binary)) return std::nullopt;
  const std::vector<WeightChannel> channels =
      channels_of(decode::load_gltf(original, decode::gltf_main_file(original)), names, rig, weight_rows(rig, frames));
  if (channels.empty()) return std::nullopt;
  GltfBuffer buffer;
  json animation = animation_of(channels, timeline, buffer);
  const json before = glb.document.value("animations", json::array());
  json all = without_channels(before, channels);
  drop_last(unread(before, all, glb.document), glb);
  append(std::move(buffer), animation, glb);
  all.insert(all.begin(), std::move(animation));
  glb.document["animations"] = std::move(all);
  return engine::File::from_bytes(decode::glb_bytes(std::move(glb.document), std::move(glb.binary)), ".glb");
}

}  // namespace face::exports
