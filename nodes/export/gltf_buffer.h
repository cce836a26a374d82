// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <bit>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/types/vec.h"

namespace face::exports {

static_assert(std::endian::native == std::endian::little,
              "glTF buffers are little-endian and written as they lie in memory");

// Builds the binary chunk of a glTF file with its accessors and buffer views.
class GltfBuffer {
 public:
  enum class Target { none = 0, vertices = 34962, indices = 34963 };

  // Each returns the index of the new accessor.
  int add_vectors(const std::vector<Vec3f>& values, bool with_bounds);
  int add_vectors(const std::vector<Vec2f>& values);
  int add_indices(const std::vector<std::uint32_t>& values);
  int add_scalars(const std::vector<float>& values, bool with_bounds);
  // count vectors that are zero but for some; `vertices` ascending.
  int add_sparse_vectors(std::size_t count, const std::vector<std::uint32_t>& vertices,
                         const std::vector<Vec3f>& values);

  std::vector<nlohmann::json> accessors;
  std::vector<nlohmann::json> views;
  std::string bytes;

 private:
  int add_view(const void* data, std::size_t size, Target target);
  int add_accessor(nlohmann::json accessor);
};

}  // namespace face::exports
