// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/fill_ratio.h"

#include <algorithm>
#include <cmath>

namespace face::texture {
namespace {

// Logarithms of ratios with weights; each level halves the size.
struct Level {
  int width = 0, height = 0;
  std::vector<Vec3f> value;
  std::vector<float> weight;
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(std::clamp(x, 0, width - 1));
  }
};

Level halved(const Level& from) {
  Level to;
  to.width = (from.width + 1) / 2;
  to.height = (from.height + 1) / 2;
  to.value.assign(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height), Vec3f{0, 0, 0});
  to.weight.assign(to.value.size(), 0.0f);
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      const std::size_t here = to.index(x, y);
      float sum = 0;
      for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
          const std::size_t i = from.index(2 * x + dx, 2 * y + dy);
          sum += from.weight[i];
          for (std::size_t c = 0; c < 3; ++c) to.value[here][c] += from.weight[i] * from.value[i][c];
        }
      if (sum > 0)
        for (float& v : to.value[here]) v /= sum;
      to.weight[here] = std::min(1.0f, sum);
    }
  return to;
}

}  // namespace

void fill_ratio(const std::vector<Vec3f>& estimate, float sure_weight, AlbedoMap& map) {
  std::vector<Level> levels(1);
  Level& finest = levels[0];
  finest.width = map.width;
  finest.height = map.height;
  finest.value.assign(map.albedo.size(), Vec3f{0, 0, 0});
  finest.weight.assign(map.albedo.size(), 0.0f);
  for (std::size_t i = 0; i < map.albedo.size(); ++i) {
    if (map.weight[i] <= 0 || estimate[i][0] <= 0) continue;
    finest.weight[i] = std::min(1.0f, map.weight[i] / sure_weight);
    for (std::size_t c = 0; c < 3; ++c)
      finest.value[i][c] = std::log(std::max(1e-3f, map.albedo[i][c]) / estimate[i][c]);
  }
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back()));
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    Level& fine = levels[l];
    const Level& coarse = levels[l + 1];
    for (int y = 0; y < fine.height; ++y)
      for (int x = 0; x < fine.width; ++x) {
        const std::size_t i = fine.index(x, y);
        const float rest = 1 - fine.weight[i];
        if (rest <= 0) continue;
        // Bilinear between the four coarse ones around.
        const float cx = 0.5f * static_cast<float>(x) - 0.25f, cy = 0.5f * static_cast<float>(y) - 0.25f;
        const int x0 = static_cast<int>(std::floor(cx)), y0 = static_cast<int>(std::floor(cy));
        const float fx = cx - static_cast<float>(x0), fy = cy - static_cast<float>(y0);
        for (std::size_t c = 0; c < 3; ++c) {
          const float value = (1 - fy) * ((1 - fx) * coarse.value[coarse.index(x0, y0)][c] +
                                          fx * coarse.value[coarse.index(x0 + 1, y0)][c]) +
                              fy * ((1 - fx) * coarse.value[coarse.index(x0, y0 + 1)][c] +
                                    fx * coarse.value[coarse.index(x0 + 1, y0 + 1)][c]);
          fine.value[i][c] = fine.weight[i] * fine.value[i][c] + rest * value;
        }
        fine.weight[i] = 1;
      }
  }
  for (std::size_t i = 0; i < map.albedo.size(); ++i)
    if (estimate[i][0] > 0 && map.weight[i] < sure_weight)
      for (std::size_t c = 0; c < 3; ++c)
        map.albedo[i][c] = std::clamp(estimate[i][c] * std::exp(levels[0].value[i][c]), 1e-3f, 4.0f);
}

}  // namespace face::texture
