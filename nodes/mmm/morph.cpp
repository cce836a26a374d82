// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/morph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/sample_image.h"
#include "nodes/flow/image_channels.h"
#include "nodes/flow/robust_flow.h"
#include "nodes/mmm/check_picture.h"

namespace face::mmm {
namespace {

// Bilinear, the edge going on; at(index) gives the vector of a pixel.
template <class At>
std::array<double, 2> between(int width, int height, double x_px, double y_px, const At& at) {
  const double x = std::clamp(x_px, 0.0, width - 1.0), y = std::clamp(y_px, 0.0, height - 1.0);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, width - 1), bottom = std::min(top + 1, height - 1);
  const double a = x - left, b = y - top;
  std::array<double, 2> sum{0, 0};
  const auto add = [&](int column, int row, double weight) {
    const auto value =
        at(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column));
    sum[0] += weight * value[0], sum[1] += weight * value[1];
  };
  add(left, top, (1 - a) * (1 - b));
  add(right, top, a * (1 - b));
  add(left, bottom, (1 - a) * b);
  add(right, bottom, a * b);
  return sum;
}

// Places that no fixed point was found for (a flow that tears leaves holes) become means of those about them, from the
// edges of the holes inwards.
void fill_holes(std::vector<Vec2f>& inverse, std::vector<std::uint8_t>& found, int width, int height) {
  std::vector<std::size_t> open;
  for (std::size_t p = 0; p < found.size(); ++p)
    if (!found[p]) open.push_back(p);
  while (!open.empty()) {
    std::vector<std::size_t> left, filled;
    std::vector<Vec2f> values;
    for (const std::size_t p : open) {
      const int x = static_cast<int>(p) % width, y = static_cast<int>(p) / width;
      double sum[2] = {0, 0}, count = 0;
      for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) {
          const auto q = static_cast<std::size_t>(j * width + i);
          if (!found[q]) continue;
          // The displacement goes on, not the place.
          sum[0] += static_cast<double>(inverse[q][0]) - i + x, sum[1] += static_cast<double>(inverse[q][1]) - j + y;
          ++count;
        }
      if (count == 0) {
        left.push_back(p);
        continue;
      }
      filled.push_back(p);
      values.push_back({static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count)});
    }
    if (filled.empty()) return;
    for (std::size_t i = 0; i < filled.size(); ++i) inverse[filled[i]] = values[i], found[filled[i]] = 1;
    open = std::move(left);
  }
}

}  // namespace

void check_model(const Mmm& model) {
  check(!model.prototypes.empty(), "the model has no prototypes, expected at least one");
  check(model.reference >= 0 && model.reference < static_cast<std::int64_t>(model.prototypes.size()), "reference is ",
        model.reference, ", expected one of the ", model.prototypes.size(), " prototypes");
  const Image& first = model.prototypes[0].image;
  for (const MmmPrototype& prototype : model.prototypes) {
    check_size(prototype.image, "prototype " + prototype.frame, first, "the first one");
    check(3 * prototype.flow_64th_px.size() == 2 * first.pixels.size(), "prototype ", prototype.frame,
          " has a flow of ", prototype.flow_64th_px.size(), " numbers, expected ", first.pixels.size() / 3 * 2);
  }
}

std::vector<Vec2f> follow_mouth(const Image& reference, const Image& image) {
  return flow::robust_flow(flow::image_channels(reference, nullptr), flow::image_channels(image, nullptr), nullptr)
      .displacement_px;
}

std::vector<Vec2f> mix_flows(const Mmm& model, const float* alpha) {
  const std::size_t count = model.prototypes[0].flow_64th_px.size() / 2;
  std::vector<Vec2f> mixed(count, Vec2f{0, 0});
  for (std::size_t i = 0; i < model.prototypes.size(); ++i) {
    const float share = alpha[i] / 64;
    if (share == 0) continue;
    const std::vector<std::int16_t>& flow = model.prototypes[i].flow_64th_px;
    for (std::size_t p = 0; p < count; ++p) {
      mixed[p][0] += share * static_cast<float>(flow[2 * p]);
      mixed[p][1] += share * static_cast<float>(flow[2 * p + 1]);
    }
  }
  return mixed;
}

std::vector<Vec2f> invert_flow(const std::vector<Vec2f>& flow, int width, int height) {
  const auto at = [&](std::size_t p) {
    return std::array<double, 2>{static_cast<double>(flow[p][0]), static_cast<double>(flow[p][1])};
  };
  std::vector<Vec2f> inverse(flow.size());
  std::vector<std::uint8_t> found(flow.size(), 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t p = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const auto miss = [&](double sx, double sy) {
        const auto d = between(width, height, sx, sy, at);
        return std::array<double, 2>{x - sx - d[0], y - sy - d[1]};
      };
      const auto here = at(p);
      double sx = x - here[0], sy = y - here[1], step = 1;
      auto error = miss(sx, sy);
      double length = std::hypot(error[0], error[1]);
      // A hundredth of a pixel is what the eye and 8 bits allow; the model itself is kept to 1/64.
      for (int round = 0; round < 25 && length > 0.01 && step > 0.05; ++round) {
        const double tx = sx + step * error[0], ty = sy + step * error[1];
        const auto next = miss(tx, ty);
        const double next_length = std::hypot(next[0], next[1]);
        if (next_length < length)
          sx = tx, sy = ty, error = next, length = next_length;
        else
          step /= 2;
      }
      inverse[p] = {static_cast<float>(sx), static_cast<float>(sy)};
      found[p] = length <= 0.5;
    }
  fill_holes(inverse, found, width, height);
  return inverse;
}

std::vector<float> morph_prototype(const Mmm& model, std::size_t prototype, const std::vector<Vec2f>& inverse,
                                   int stride_px) {
  const Image& image = model.prototypes[prototype].image;
  const std::vector<std::int16_t>& flow = model.prototypes[prototype].flow_64th_px;
  const auto at = [&](std::size_t p) { return std::array<double, 2>{flow[2 * p] / 64.0, flow[2 * p + 1] / 64.0}; };
  std::vector<float> values;
  for (int y = 0; y < image.height; y += stride_px)
    for (int x = 0; x < image.width; x += stride_px) {
      const Vec2f& from =
          inverse[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)];
      const double fx = static_cast<double>(from[0]), fy = static_cast<double>(from[1]);
      const auto d = between(image.width, image.height, fx, fy, at);
      float rgb[3];
      sample_image(image, fx + d[0], fy + d[1], rgb);
      values.insert(values.end(), rgb, rgb + 3);
    }
  return values;
}

}  // namespace face::mmm
