// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/gltf_compression.h"

#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/glb.h"

namespace face::decode {
namespace {

using nlohmann::json;

constexpr const char* meshopt = "EXT_meshopt_compression";
constexpr const char* draco_name = "KHR_draco_mesh_compression";
constexpr std::size_t most_rows = 1u << 28, most_row_bytes = 256;  // a larger mesh is a broken file

json* extension_of(json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return nullptr;
  const auto extension = extensions->find(name);
  return extension == extensions->end() ? nullptr : &*extension;
}

void remove_extension(json& object, const char* name) {
  object["extensions"].erase(name);
  if (object["extensions"].empty()) object.erase("extensions");
}

// The bytes at a place of the binary chunk.
std::string_view bytes_at(const json& place, const std::string& binary, const std::string& what) {
  const std::size_t offset = place.value("byteOffset", std::size_t{0}),
                    size = place.at("byteLength").get<std::size_t>();
  if (place.value("buffer", std::size_t{0}) != 0 || offset > binary.size() || size > binary.size() - offset)
    fail(what, ": reaches byte ", offset + size, ", its buffer has ", binary.size());
  return std::string_view(binary).substr(offset, size);
}

// Puts bytes behind the binary chunk; the view is where they lie now.
void place_view(json& view, std::string_view bytes, std::string& binary) {
  pad(binary);
  view["buffer"] = 0;
  view["byteOffset"] = binary.size();
  view["byteLength"] = bytes.size();
  binary += bytes;
}

// The rows of a packed view. (Extension EXT_meshopt_compression 1.0.)
std::string unpacked(const json& packed, const std::string& binary, const std::string& what) {
  const std::string_view from = bytes_at(packed, binary, what);
  const auto count = packed.at("count").get<std::size_t>(), stride = packed.at("byteStride").get<std::size_t>();
  const std::string mode = packed.at("mode").get<std::string>(), filter = packed.value("filter", "NONE");
  check(count <= most_rows && stride > 0 && stride <= most_row_bytes, what, ": has ", count, " rows of ", stride,
        " bytes, expected at most ", most_rows, " of ", most_row_bytes);
  const bool indices = mode == "TRIANGLES" || mode == "INDICES";
  check(indices || mode == "ATTRIBUTES", what, ": is packed as \"", mode,
        "\", expected \"ATTRIBUTES\", \"TRIANGLES\" or \"INDICES\"");
  check(indices ? stride == 2 || stride == 4 : stride % 4 == 0, what, ": has rows of ", stride, " bytes, expected ",
        indices ? "2 or 4" : "a multiple of 4");
  check(mode != "TRIANGLES" || count % 3 == 0, what, ": has ", count, " indices, expected whole triangles");
  std::string rows(count * stride, '\0');
  const auto* data = reinterpret_cast<const unsigned char*>(from.data());
  const int code = mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(rows.data(), count, stride, data, from.size())
                   : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(rows.data(), count, stride, data, from.size())
                                         : meshopt_decodeIndexSequence(rows.data(), count, stride, data, from.size());
  check(code == 0, what, ": its ", from.size(), " packed bytes are damaged, or of a version that is not read");
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
    meshopt_decodeFilterOct(rows.data(), count, stride);
  } else if (filter == "QUATERNION" && stride == 8) {
    meshopt_decodeFilterQuat(rows.data(), count, stride);
  } else if (filter == "EXPONENTIAL" && stride % 4 == 0) {
    meshopt_decodeFilterExp(rows.data(), count, stride);
  } else {
    check(filter == "NONE", what, ": has the filter \"", filter, "\" on rows of ", stride,
          " bytes, expected \"NONE\", \"OCTAHEDRAL\" (4 or 8 bytes), \"QUATERNION\" (8) or \"EXPONENTIAL\"");
  }
  return rows;
}

void undo_meshopt(json& document, std::string& binary, const std::string& title) {
  std::size_t index = 0;
  for (json& view : document["bufferViews"]) {
    const std::string what = message(title, " buffer view ", index++);
    const json* const packed = meshopt_of(view);
    if (!packed) continue;
    place_view(view, unpacked(*packed, binary, what), binary);
    remove_extension(view, meshopt);
  }
}

int components_of(const std::string& type, const std::string& what) {
  constexpr std::array types = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const auto found = std::find(types.begin(), types.end(), type);
  check(found != types.end(), what, ": is a list of ", type, ", expected SCALAR, VEC2, VEC3 or VEC4");
  return static_cast<int>(found - types.begin()) + 1;
}

// An attribute's rows, one per point, each filled up to 4 bytes as rows of vertices have to be. Bounds that the
// accessor states become theirs: packing moved the values a little.
template <class T>
std::string rows_of(const draco::PointAttribute& attribute, std::size_t points, json& accessor,
                    const std::string& what) {
  const int components = components_of(accessor.at("type").get<std::string>(), what);
  const auto width = static_cast<std::size_t>(components);
  const std::size_t stride = (width * sizeof(T) + 3) / 4 * 4;
  std::string rows(points * stride, '\0');
  std::array<T, 4> row{}, low{}, high{};
  for (std::size_t p = 0; p < points; ++p) {
    const auto index = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(p)));
    check(attribute.ConvertValue<T>(index, static_cast<std::int8_t>(components), row.data()), what,
          ": holds numbers that its component type cannot");
    for (std::size_t c = 0; c < width; ++c) {
      low[c] = p == 0 ? row[c] : std::min(low[c], row[c]);
      high[c] = p == 0 ? row[c] : std::max(high[c], row[c]);
    }
    std::copy_n(reinterpret_cast<const char*>(row.data()), width * sizeof(T), rows.data() + p * stride);
  }
  if (accessor.contains("min")) accessor["min"] = std::vector<T>(low.begin(), low.begin() + components);
  if (accessor.contains("max")) accessor["max"] = std::vector<T>(high.begin(), high.begin() + components);
  return rows;
}

// The same in the component type of the glTF accessor (glTF 2.0, section 3.6.2.2).
std::string typed_rows_of(const draco::PointAttribute& attribute, std::size_t points, json& accessor,
                          const std::string& what) {
  switch (const int type = accessor.at("componentType").get<int>()) {
    case 5120:
      return rows_of<std::int8_t>(attribute, points, accessor, what);
    case 5121:
      return rows_of<std::uint8_t>(attribute, points, accessor, what);
    case 5122:
      return rows_of<std::int16_t>(attribute, points, accessor, what);
    case 5123:
      return rows_of<std::uint16_t>(attribute, points, accessor, what);
    case 5125:
      return rows_of<std::uint32_t>(attribute, points, accessor, what);
    case 5126:
      return rows_of<float>(attribute, points, accessor, what);
    default:
      fail(what, ": has component type ", type, ", expected one of glTF 2.0");
  }
}

// Gives an accessor `count` rows of its own. stride: 0 for indices.
void place_accessor(json& document, json& accessor, std::size_t count, std::size_t stride, std::string_view bytes,
                    std::string& binary) {
  json view = {{"target", stride > 0 ? 34962 : 34963}};  // glTF 2.0, section 5.11.5: vertices, indices
  place_view(view, bytes, binary);
  if (stride > 0) view["byteStride"] = stride;
  document["bufferViews"].push_back(std::move(view));
  accessor["bufferView"] = document["bufferViews"].size() - 1;
  accessor.erase("byteOffset");
  accessor["count"] = count;
}

void undo_draco_of(json& document, json& primitive, const json& packed, std::string& binary, const std::string& what) {
  const auto view = packed.at("bufferView").get<std::size_t>();
  const json& views = document.at("bufferViews");
  check(view < views.size(), what, ": found buffer view ", view, ", expected one of ", views.size());
  const std::string from(bytes_at(views[view], binary, what));
  draco::DecoderBuffer buffer;
  buffer.Init(from.data(), from.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) fail(what, ": its Draco bytes are damaged: ", decoded.status().error_msg());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  const std::size_t points = mesh->num_points(), faces = mesh->num_faces();

  json& accessors = document.at("accessors");
  const auto accessor_at = [&](const json& index) -> json& {
    const auto i = index.get<std::size_t>();
    check(i < accessors.size(), what, ": found accessor ", i, ", expected one of ", accessors.size());
    return accessors[i];
  };
  if (primitive.contains("indices")) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t f = 0; f < faces; ++f)
      for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f))) corners.push_back(corner.value());
    json& accessor = accessor_at(primitive.at("indices"));
    accessor["componentType"] = 5125;
    const std::string_view bytes(reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(std::uint32_t));
    place_accessor(document, accessor, corners.size(), 0, bytes, binary);
  }
  for (const auto& [name, id] : packed.at("attributes").items()) {
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id.get<std::uint32_t>());
    check(attribute != nullptr, what, ": its Draco bytes hold no ", name);
    json& accessor = accessor_at(primitive.at("attributes").at(name));
    const std::string rows = typed_rows_of(*attribute, points, accessor, what);
    place_accessor(document, accessor, points, points > 0 ? rows.size() / points : 0, rows, binary);
  }
  primitive.erase("mode");  // a strip too is unpacked to triangles
}

void undo_draco(json& document, std::string& binary, const std::string& title) {
  if (!document.contains("meshes")) return;
  std::size_t index = 0;
  for (json& mesh : document["meshes"]) {
    const std::string what = message(title, " mesh ", index++);
    for (json& primitive : mesh.at("primitives")) {
      const json* const packed = extension_of(primitive, draco_name);
      if (!packed) continue;
      undo_draco_of(document, primitive, json(*packed), binary, what);
      remove_extension(primitive, draco_name);
    }
  }
}

}  // namespace

bool mentions_compression(std::string_view bytes) {
  return bytes.find(meshopt) != std::string_view::npos || bytes.find(draco_name) != std::string_view::npos;
}

json* meshopt_of(json& view) { return extension_of(view, meshopt); }

void undo_compression(json& document, std::string& binary, const std::string& title) {
  undo_meshopt(document, binary, title);
  undo_draco(document, binary, title);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    if (!document.contains(list)) continue;
    json& names = document[list];
    for (auto name = names.begin(); name != names.end();)
      name = *name == meshopt || *name == draco_name ? names.erase(name) : name + 1;
    if (names.empty()) document.erase(list);
  }
}

}  // namespace face::decode
