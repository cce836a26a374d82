// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/merge.h"

#include <algorithm>

#include "nodes/base/check.h"

namespace face::texture {
namespace {

// What a texel that no picture shows counts beside one that some does.
constexpr float hidden_weight = 1e-4f;

}  // namespace

AlbedoMap merge(const engine::Seq<AlbedoMap>& maps) {
  check(!maps.empty(), "there are no maps");
  AlbedoMap merged;
  std::vector<float> total;
  for (const AlbedoMap& map : maps) {
    if (merged.albedo.empty()) {
      merged.width = map.width;
      merged.height = map.height;
      merged.albedo.assign(map.albedo.size(), Vec3f{0, 0, 0});
      merged.weight.assign(map.albedo.size(), 0.0f);
      total.assign(map.albedo.size(), 0.0f);
    }
    check(map.width == merged.width && map.height == merged.height, "a map is ", map.width, " x ", map.height,
          " texels, the first ", merged.width, " x ", merged.height);
    for (std::size_t i = 0; i < map.albedo.size(); ++i) {
      const float weight = map.weight[i] + hidden_weight;
      total[i] += weight;
      merged.weight[i] = std::max(merged.weight[i], map.weight[i]);
      for (std::size_t c = 0; c < 3; ++c) merged.albedo[i][c] += weight * map.albedo[i][c];
    }
  }
  for (std::size_t i = 0; i < merged.albedo.size(); ++i)
    for (float& value : merged.albedo[i]) value /= total[i];
  return merged;
}

}  // namespace face::texture
