// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/gltf_buffer.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "nodes/decode/glb.h"

namespace face::exports {
namespace {

// Constants of the glTF 2.0 specification, section 3.6.2.2.
constexpr int float_component = 5126;
constexpr int uint_component = 5125;

void set_bounds(nlohmann::json& accessor, const Vec3f& low, const Vec3f& high) {
  accessor["min"] = low;
  accessor["max"] = high;
}

// Bounds of vectors; from zero where the rest of an accessor is zero.
std::pair<Vec3f, Vec3f> bounds_of(const std::vector<Vec3f>& values, bool and_zero) {
  if (values.empty()) return {{0, 0, 0}, {0, 0, 0}};
  Vec3f low = and_zero ? Vec3f{0, 0, 0} : values.front(), high = low;
  for (const Vec3f& value : values)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], value[axis]);
      high[axis] = std::max(high[axis], value[axis]);
    }
  return {low, high};
}

}  // namespace

int GltfBuffer::add_view(const void* data, std::size_t size, Target target) {
  decode::pad(bytes);
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
  if (target != Target::none) view["target"] = static_cast<int>(target);
  bytes.append(static_cast<const char*>(data), size);
  views.push_back(std::move(view));
  return static_cast<int>(views.size()) - 1;
}

int GltfBuffer::add_accessor(nlohmann::json accessor) {
  accessors.push_back(std::move(accessor));
  return static_cast<int>(accessors.size()) - 1;
}

int GltfBuffer::add_vectors(const std::vector<Vec3f>& values, bool with_bounds) {
  nlohmann::json accessor = {{"bufferView", add_view(values.data(), values.size() * sizeof(Vec3f), Target::vertices)},
                             {"componentType", float_component},
                             {"count", values.size()},
                             {"type", "VEC3"}};
  if (with_bounds) {
    const auto [low, high] = bounds_of(values, false);
    set_bounds(accessor, low, high);
  }
  return add_accessor(std::move(accessor));
}

int GltfBuffer::add_vectors(const std::vector<Vec2f>& values) {
  return add_accessor({{"bufferView", add_view(values.data(), values.size() * sizeof(Vec2f), Target::vertices)},
                       {"componentType", float_component},
                       {"count", values.size()},
                       {"type", "VEC2"}});
}

int GltfBuffer::add_indices(const std::vector<std::uint32_t>& values) {
  return add_accessor({{"bufferView", add_view(values.data(), values.size() * sizeof(std::uint32_t), Target::indices)},
                       {"componentType", uint_component},
                       {"count", values.size()},
                       {"type", "SCALAR"}});
}

int GltfBuffer::add_scalars(const std::vector<float>& values, bool with_bounds) {
  nlohmann::json accessor = {{"bufferView", add_view(values.data(), values.size() * sizeof(float), Target::none)},
                             {"componentType", float_component},
                             {"count", values.size()},
                             {"type", "SCALAR"}};
  if (with_bounds) {
    accessor["min"] = {*std::min_element(values.begin(), values.end())};
    accessor["max"] = {*std::max_element(values.begin(), values.end())};
  }
  return add_accessor(std::move(accessor));
}

int GltfBuffer::add_sparse_vectors(std::size_t count, const std::vector<std::uint32_t>& vertices,
                                   const std::vector<Vec3f>& values) {
  nlohmann::json accessor = {{"componentType", float_component}, {"count", count}, {"type", "VEC3"}};
  // An accessor without a buffer view is all zeros. (Sparse with no element would be invalid.)
  const auto [low, high] = bounds_of(values, vertices.size() < count);
  set_bounds(accessor, low, high);
  if (!vertices.empty()) {
    const int indices_view = add_view(vertices.data(), vertices.size() * sizeof(std::uint32_t), Target::none);
    const int values_view = add_view(values.data(), values.size() * sizeof(Vec3f), Target::none);
    accessor["sparse"] = {{"count", vertices.size()},
                          {"indices", {{"bufferView", indices_view}, {"componentType", uint_component}}},
                          {"values", {{"bufferView", values_view}}}};
  }
  return add_accessor(std::move(accessor));
}

}  // namespace face::exports
