// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/glb.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/gltf_compression.h"
#include "nodes/decode/gltf_file.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "the sizes in a GLB are little-endian");

// Constants of the glTF 2.0 specification, section 4.4.
constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
constexpr std::uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

void append_uint(std::string& out, std::uint32_t value) {
  char bytes[4];
  std::memcpy(bytes, &value, 4);
  out.append(bytes, 4);
}

std::uint32_t uint_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
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

// What an object refers to by `uri`; none where that is not there.
std::optional<std::string> content_of(const std::string& uri, const engine::File& given) {
  if (uri.starts_with("data:")) {
    std::vector<unsigned char> bytes;
    std::string media_type;
    if (!tinygltf::DecodeDataURI(&bytes, media_type, uri, 0, false)) return std::nullopt;
    return std::string(bytes.begin(), bytes.end());
  }
  const std::string path = given.find(file_name_of(uri));
  if (path.empty()) return std::nullopt;
  return read_bytes_at(path, uri);
}

std::size_t put_behind(const std::string& content, std::string& binary) {
  pad(binary);
  const std::size_t place = binary.size();
  binary += content;
  return place;
}

std::string media_type_of(const std::string& uri) {
  const std::string suffix = lower(uri.substr(std::min(uri.rfind('.'), uri.size())));
  if (suffix == ".jpg" || suffix == ".jpeg") return "image/jpeg";
  return suffix.empty() ? "image/png" : "image/" + suffix.substr(1);
}

// Brings all buffers, and pictures that lie in files beside it, into the binary chunk. False where a buffer is missing.
bool take_in(const engine::File& given, json& document, std::string& binary) {
  std::vector<std::optional<std::size_t>> places;  // of the file's buffers in the binary chunk
  for (const json& buffer : document["buffers"]) {
    const std::string uri = buffer.value("uri", "");
    if (uri.empty()) {
      places.push_back(places.empty() ? std::optional<std::size_t>(0) : std::nullopt);
      continue;
    }
    const std::optional<std::string> content = content_of(uri, given);
    if (!content) return false;
    places.emplace_back(put_behind(*content, binary));
  }
  const auto move = [&](json& place) {
    const std::size_t buffer = place.value("buffer", std::size_t{0});
    if (buffer >= places.size() || !places[buffer]) return false;
    place["buffer"] = 0;
    if (*places[buffer] > 0) place["byteOffset"] = place.value("byteOffset", std::size_t{0}) + *places[buffer];
    return true;
  };
  for (json& view : document["bufferViews"]) {
    json* const packed = meshopt_of(view);
    if (!move(packed ? *packed : view)) return false;
  }
  if (document.contains("images"))
    for (json& image : document["images"]) {
      const std::string uri = image.value("uri", "");
      if (uri.empty() || uri.starts_with("data:")) continue;
      const std::optional<std::string> content = content_of(uri, given);
      if (!content) continue;
      document["bufferViews"].push_back(
          {{"buffer", 0}, {"byteOffset", put_behind(*content, binary)}, {"byteLength", content->size()}});
      image["mimeType"] = media_type_of(uri);
      image["bufferView"] = document["bufferViews"].size() - 1;
      image.erase("uri");
    }
  document["buffers"] = json::array({json::object()});
  return true;
}

}  // namespace

void pad(std::string& bytes, char filler) { bytes.resize((bytes.size() + 3) / 4 * 4, filler); }

bool read_glb(const engine::File& given, json& document, std::string& binary) {
  const std::optional<engine::File> file = find_gltf(given);
  if (!file) return false;
  const std::string bytes = read_bytes(*file), title = title_of(*file);
  const bool is_binary = bytes.starts_with("glTF") && bytes.size() >= header_bytes;
  std::size_t at = header_bytes;
  document = json::parse(is_binary ? next_chunk(bytes, at, title) : std::string_view(bytes), nullptr, false);
  binary.clear();
  if (is_binary && !document.is_object()) fail(title, ": is damaged: its JSON cannot be read");
  if (!document.is_object() || !document.contains("asset")) return false;
  if (is_binary && at < bytes.size()) binary = next_chunk(bytes, at, title);
  for (const char* list : {"buffers", "bufferViews", "accessors"})
    if (!document.contains(list)) return false;
  try {
    if (!take_in(given, document, binary)) return false;
    undo_compression(document, binary, title);
  } catch (const json::exception& error) {
    fail(title, ": is damaged: ", error.what());
  }
  return true;
}

std::string glb_bytes(json document, std::string binary) {
  pad(binary);
  document["buffers"][0] = {{"byteLength", binary.size()}};
  std::string text = document.dump();
  pad(text, ' ');
  const std::size_t size = header_bytes + chunk_header_bytes + text.size() + chunk_header_bytes + binary.size();
  check(size <= std::numeric_limits<std::uint32_t>::max(), "the GLB would have ", size,
        " bytes, which is more than the ", std::numeric_limits<std::uint32_t>::max(), " that the format can hold");
  std::string out;
  out.reserve(size);
  append_uint(out, glb_magic);
  append_uint(out, 2);
  append_uint(out, static_cast<std::uint32_t>(size));
  append_uint(out, static_cast<std::uint32_t>(text.size()));
  append_uint(out, json_chunk);
  out += text;
  append_uint(out, static_cast<std::uint32_t>(binary.size()));
  append_uint(out, binary_chunk);
  out += binary;
  return out;
}

}  // namespace face::decode
