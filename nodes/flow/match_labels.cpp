// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/match_labels.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"

namespace face::flow {
namespace {

// Costs of the displacements of one pixel: a column for each horizontal one, with a column of the largest number on
// either side, and so within a column: neighbours then need no care at the borders.
constexpr int column = 32;
constexpr float never = 1e30f;

class Labels {
 public:
  explicit Labels(const MatchLabelsOptions& options)
      : reach_x(options.reach_x_px), reach_y(options.reach_y_px), columns(2 * reach_x + 3), size(columns * column) {}
  int at(int u, int v) const { return (u + reach_x + 1) * column + v + reach_y + 1; }
  int u_of(int label) const { return label / column - reach_x - 1; }
  int v_of(int label) const { return label % column - reach_y - 1; }

  int reach_x, reach_y, columns, size;
};

// cost + the cheapest way from a neighbour, less that neighbour's least.
void step(const Labels& labels, const MatchLabelsOptions& options, const float* cost, const float* from, float* scratch,
          float* to) {
  float least = never;
  for (int i = 0; i < labels.size; ++i) least = std::min(least, from[i]);
  const float top = least + options.jump_cost;
  for (int c = 1; c + 1 < labels.columns; ++c) {
    const float *here = from + c * column, *before = here - column, *after = here + column;
    float* out = scratch + c * column;
    for (int i = 0; i < column; ++i) out[i] = std::min(here[i], std::min(before[i], after[i]) + options.step_cost);
  }
  for (int c = 1; c + 1 < labels.columns; ++c) {
    const float *here = scratch + c * column, *mine = cost + c * column;
    float* out = to + c * column;
    for (int i = 1; i + 1 < column; ++i) {
      const float near = std::min(here[i], std::min(here[i - 1], here[i + 1]) + options.step_cost);
      out[i] = mine[i] + std::min(near, top) - least;
    }
  }
}

}  // namespace

float match_cost(const Level& picture, const Level& other, const MatchLabelsOptions& options, int x, int y, int other_x,
                 int other_y) {
  const auto outside = [](const Plane& plane, int px, int py) {
    return px < 0 || py < 0 || px >= plane.width || py >= plane.height || plane.row(py)[px] < 0.5f;
  };
  const bool unseen = outside(picture.share, x, y) || outside(other.share, other_x, other_y);
  float sum = 0;
  for (std::size_t c = 0; c < options.weights.size(); ++c) {
    const float difference = unseen
                                 ? 0.5f * options.caps[c]
                                 : std::fabs(picture.channels[c].row(y)[x] - other.channels[c].row(other_y)[other_x]);
    sum += std::sqrt(options.weights[c]) * std::min(difference, options.caps[c]);
  }
  return sum;
}

void match_labels(const Level& picture, const Level& other, const PixelBox& box, const MatchLabelsOptions& options,
                  Plane& u, Plane& v) {
  check(options.reach_x_px >= 0 && options.reach_y_px >= 0 && 2 * options.reach_y_px + 3 <= column, "reach is ",
        options.reach_x_px, " x ", options.reach_y_px, " px, expected at most ", (column - 3) / 2, " px vertically");
  const Labels labels(options);
  const int width = box.right - box.left + 1, height = box.bottom - box.top + 1;
  if (width <= 0 || height <= 0) return;
  const auto size = static_cast<std::size_t>(labels.size);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto pixel = [&](int x, int y) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * size;
  };
  const auto centre = [&](const Plane& plane, int x, int y) {
    return static_cast<int>(std::lround(plane.row(box.top + y)[box.left + x]));
  };
  std::vector<float> costs(count * size, never), sums(count * size, 0), path(count * size, never), scratch(size, never);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int px = box.left + x, py = box.top + y, qx = px + centre(u, x, y), qy = py + centre(v, x, y);
      float* cost = costs.data() + pixel(x, y);
      for (int i = -labels.reach_x; i <= labels.reach_x; ++i)
        for (int j = -labels.reach_y; j <= labels.reach_y; ++j)
          cost[labels.at(i, j)] = match_cost(picture, other, options, px, py, qx + i, qy + j);
    }
  constexpr int ways[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
  for (const auto& way : ways)
    for (int k = 0; k < height; ++k)
      for (int m = 0; m < width; ++m) {
        const int x = way[0] >= 0 ? m : width - 1 - m, y = way[1] >= 0 ? k : height - 1 - k;
        const int before_x = x - way[0], before_y = y - way[1];
        const float* cost = costs.data() + pixel(x, y);
        float* to = path.data() + pixel(x, y);
        if (before_x < 0 || before_y < 0 || before_x >= width || before_y >= height)
          std::copy(cost, cost + size, to);
        else
          step(labels, options, cost, path.data() + pixel(before_x, before_y), scratch.data(), to);
        float* sum = sums.data() + pixel(x, y);
        for (std::size_t i = 0; i < size; ++i) sum[i] += to[i];
      }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* sum = sums.data() + pixel(x, y);
      int best = labels.at(0, 0);
      for (int i = -labels.reach_x; i <= labels.reach_x; ++i)
        for (int j = -labels.reach_y; j <= labels.reach_y; ++j)
          if (sum[labels.at(i, j)] < sum[best]) best = labels.at(i, j);
      const int found_u = centre(u, x, y) + labels.u_of(best), found_v = centre(v, x, y) + labels.v_of(best);
      u.row(box.top + y)[box.left + x] = static_cast<float>(found_u);
      v.row(box.top + y)[box.left + x] = static_cast<float>(found_v);
    }
}

}  // namespace face::flow
