// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/animate_original.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/gltf_file.h"
#include "nodes/decode/input_file.h"
#include "nodes/export/gltf_animation.h"

namespace face::exports {
namespace {

using nlohmann::json;

constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;

// The JSON of a GLB, and its binary chunk.
struct Glb {
  json document;
  std::string binary;
};

std::uint32_t uint_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);  // gltf_buffer.h: this machine is little-endian
  return value;
}

// The chunk at `at`, which moves behind it.
std::string_view next_chunk(std::string_view bytes, std::size_t& at, const std::string& title) {
  const std::size_t size = at + chunk_header_bytes <= bytes.size() ? uint_at(bytes, at) : bytes.size();
  if (at + chunk_header_bytes + size > bytes.size())
    fail(title, ": is truncated: found ", bytes.size(), " bytes, a chunk at byte ", at, " promises more");
  const std::string_view chunk = bytes.substr(at + chunk_header_bytes, size);
  at += chunk_header_bytes + size;
  return chunk;
}

// The name of a file that a glTF file refers to: %20 is a space.
std::string file_name_of(const std::string& uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, uri.data() + i + 3, value, 16).ptr == uri.data() + i + 3) {
      name += static_cast<char>(value);
      i += 2;
    } else {
      name += uri[i];
    }
  }
  return name;
}

// Puts what an object refers to by `uri` behind the binary chunk and gives its place there; none where it refers to
// nothing that was given, or holds it itself.
std::optional<std::size_t> take_in(const json& object, const engine::File& given, std::string& binary) {
  const std::string uri = object.value("uri", "");
  if (uri.empty() || uri.starts_with("data:")) return std::nullopt;
  const std::string path = given.find(file_name_of(uri));
  if (path.empty()) return std::nullopt;
  binary.resize((binary.size() + 3) / 4 * 4);
  const std::size_t place = binary.size();
  binary += decode::read_bytes_at(path, uri);
  return place;
}

std::string media_type(const std::string& uri) {
  const std::string suffix = decode::lower(uri.substr(std::min(uri.rfind('.'), uri.size())));
  if (suffix == ".jpg" || suffix == ".jpeg") return "image/jpeg";
  return suffix.empty() ? "image/png" : "image/" + suffix.substr(1);
}

// Brings buffers and pictures that lie in files beside it into the binary chunk, as the first buffer. False where a
// buffer is not there.
bool take_in_files(const engine::File& given, Glb& glb) {
  json& document = glb.document;
  json buffers = json::array({json::object()});
  std::vector<std::pair<std::size_t, std::size_t>> now;  // buffer and place of each of the file's
  for (json& buffer : document["buffers"]) {
    if (!buffer.contains("uri")) {
      now.emplace_back(0, 0);
    } else if (const auto place = take_in(buffer, given, glb.binary)) {
      now.emplace_back(0, *place);
    } else if (buffer["uri"].get<std::string>().starts_with("data:")) {
      now.emplace_back(buffers.size(), 0);
      buffers.push_back(std::move(buffer));
    } else {
      return false;
    }
  }
  for (json& view : document["bufferViews"]) {
    const std::size_t buffer = view.value("buffer", std::size_t{0});
    if (buffer >= now.size()) return false;
    view["buffer"] = now[buffer].first;
    if (now[buffer].second > 0) view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + now[buffer].second;
  }
  if (document.contains("images"))
    for (json& image : document["images"]) {
      const auto place = take_in(image, given, glb.binary);
      if (!place) continue;
      document["bufferViews"].push_back(
          {{"buffer", 0}, {"byteOffset", *place}, {"byteLength", glb.binary.size() - *place}});
      image["mimeType"] = media_type(image["uri"].get<std::string>());
      image["bufferView"] = document["bufferViews"].size() - 1;
      image.erase("uri");
    }
  document["buffers"] = std::move(buffers);
  return true;
}

// None for what is no glTF file.
std::optional<Glb> read_original(const engine::File& given) {
  const std::optional<engine::File> file = decode::find_gltf(given);
  if (!file) return std::nullopt;
  const std::string bytes = decode::read_bytes(*file), title = decode::title_of(*file);
  const bool binary = bytes.starts_with("glTF") && bytes.size() >= header_bytes;
  std::size_t at = header_bytes;
  Glb glb{json::parse(binary ? next_chunk(bytes, at, title) : std::string_view(bytes), nullptr, false), {}};
  if (binary && !glb.document.is_object()) fail(title, ": is damaged: its JSON cannot be read");
  if (!glb.document.is_object() || !glb.document.contains("asset")) return std::nullopt;
  if (binary && at < bytes.size()) glb.binary = next_chunk(bytes, at, title);
  for (const char* list : {"buffers", "bufferViews", "accessors"})
    if (!glb.document.contains(list)) return std::nullopt;  // it has no mesh
  if (!take_in_files(given, glb)) return std::nullopt;
  return glb;
}

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

// Puts the new accessors behind those of the file.
void append(GltfBuffer buffer, json& animation, Glb& glb) {
  json& document = glb.document;
  const std::size_t views = document["bufferViews"].size(), accessors = document["accessors"].size();
  while (glb.binary.size() % 4 != 0) glb.binary += '\0';
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
  std::optional<Glb> glb = read_original(original);
  if (!glb) return std::nullopt;
  const std::vector<WeightChannel> channels =
      channels_of(decode::load_gltf(original, decode::gltf_main_file(original)), names, rig, weight_rows(rig, frames));
  if (channels.empty()) return std::nullopt;
  GltfBuffer buffer;
  json animation = animation_of(channels, timeline, buffer);
  append(std::move(buffer), animation, *glb);
  json all = without_channels(glb->document.value("animations", json::array()), channels);
  all.insert(all.begin(), std::move(animation));
  glb->document["animations"] = std::move(all);
  return engine::File::from_bytes(glb_bytes(std::move(glb->document), std::move(glb->binary)), ".glb");
}

}  // namespace face::exports
