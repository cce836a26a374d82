// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/patch.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/luma.h"

namespace face::track {
namespace {

// Subtracts the mean and divides by the norm; returns false for a patch without contrast.
bool normalise(std::vector<float>& patch) {
  double mean = 0;
  for (const float x : patch) mean += static_cast<double>(x);
  mean /= static_cast<double>(patch.size());
  double square = 0;
  for (float& x : patch) {
    x -= static_cast<float>(mean);
    square += static_cast<double>(x) * static_cast<double>(x);
  }
  if (square < 1e-6 * static_cast<double>(patch.size())) return false;
  const auto scale = static_cast<float>(1 / std::sqrt(square));
  for (float& x : patch) x *= scale;
  return true;
}

double product(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return sum;
}

}  // namespace

float Grey::at(double x, double y) const {
  x = std::clamp(x, 0.0, static_cast<double>(width - 1));
  y = std::clamp(y, 0.0, static_cast<double>(height - 1));
  const int x0 = std::min(static_cast<int>(x), std::max(width - 2, 0)),
            y0 = std::min(static_cast<int>(y), std::max(height - 2, 0));
  const int x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
  const auto u = static_cast<float>(x - x0), v = static_cast<float>(y - y0);
  const auto pixel = [&](int px, int py) { return values[static_cast<std::size_t>(py * width + px)]; };
  return (pixel(x0, y0) * (1 - u) + pixel(x1, y0) * u) * (1 - v) + (pixel(x0, y1) * (1 - u) + pixel(x1, y1) * u) * v;
}

Grey grey_of(const Image& image) { return grey_of(image, 0, 0, image.width, image.height); }

Grey grey_of(const Image& image, int left, int top, int width, int height) {
  Grey grey{width, height, {}};
  const auto channels = static_cast<std::size_t>(image.channels), columns = static_cast<std::size_t>(width);
  grey.values.resize(columns * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* const p = &image.pixels[static_cast<std::size_t>((top + y) * image.width + left) * channels];
    float* const row = &grey.values[static_cast<std::size_t>(y) * columns];
    if (channels == 3)  // told, so that it is done for several pixels at once
      for (std::size_t i = 0; i < columns; ++i) row[i] = grey_value<float>(p + i * 3, 3);
    else
      for (std::size_t i = 0; i < columns; ++i) row[i] = grey_value<float>(p + i * channels, image.channels);
  }
  return grey;
}

std::vector<float> cut_patch(const Grey& grey, double x_px, double y_px, int side_px) {
  std::vector<float> patch;
  patch.reserve(static_cast<std::size_t>(side_px * side_px));
  const double half = (side_px - 1) / 2.0;
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x) patch.push_back(grey.at(x_px + x - half, y_px + y - half));
  return patch;
}

std::vector<float> middle_of(const std::vector<float>& patch, int patch_side_px, int side_px) {
  const int margin = (patch_side_px - side_px) / 2;
  std::vector<float> middle;
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      middle.push_back(patch[static_cast<std::size_t>((y + margin) * patch_side_px + x + margin)]);
  return middle;
}

int telling_side_px(const std::vector<float>& patch, int patch_side_px, int least_px) {
  constexpr double least_texture = 12, least_roundness = 0.2;  // smaller eigenvalue; its share of the larger one
  const auto at = [&](int x, int y) {
    return static_cast<double>(patch[static_cast<std::size_t>(y * patch_side_px + x)]);
  };
  for (int side = least_px; side < patch_side_px; side += 2) {
    const int margin = (patch_side_px - side) / 2;
    double xx = 0, xy = 0, yy = 0;
    for (int y = margin; y < margin + side; ++y)
      for (int x = margin; x < margin + side; ++x) {
        const double gx = (at(x + 1, y) - at(x - 1, y)) / 2, gy = (at(x, y + 1) - at(x, y - 1)) / 2;
        xx += gx * gx / (side * side), xy += gx * gy / (side * side), yy += gy * gy / (side * side);
      }
    const double mean = (xx + yy) / 2, spread = std::hypot((xx - yy) / 2, xy);
    if (mean - spread >= least_texture && mean - spread >= least_roundness * (mean + spread)) return side;
  }
  return patch_side_px;
}

PatchMatch align_patch(const std::vector<float>& patch, int side_px, const Grey& grey, double x_px, double y_px) {
  PatchMatch match{x_px, y_px, 0, false};
  std::vector<float> wanted = patch;
  if (!normalise(wanted)) return match;
  // Steepest descent images of the normalised patch, and their Hessian, once.
  const auto at = [&](int x, int y) {
    return wanted[static_cast<std::size_t>(std::clamp(y, 0, side_px - 1) * side_px + std::clamp(x, 0, side_px - 1))];
  };
  std::vector<float> dx, dy;
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x) {
      dx.push_back((at(x + 1, y) - at(x - 1, y)) / (x == 0 || x == side_px - 1 ? 1.0f : 2.0f));
      dy.push_back((at(x, y + 1) - at(x, y - 1)) / (y == 0 || y == side_px - 1 ? 1.0f : 2.0f));
    }
  const double xx = product(dx, dx), xy = product(dx, dy), yy = product(dy, dy), det = xx * yy - xy * xy;
  if (det <= 1e-12) return match;
  for (int i = 0; i < 30; ++i) {
    std::vector<float> seen = cut_patch(grey, match.x_px, match.y_px, side_px);
    if (!normalise(seen)) return match;
    match.likeness = product(wanted, seen);
    std::vector<float> difference(seen.size());
    for (std::size_t k = 0; k < seen.size(); ++k) difference[k] = seen[k] - wanted[k];
    const double bx = product(dx, difference), by = product(dy, difference);
    const double step_x = (yy * bx - xy * by) / det, step_y = (xx * by - xy * bx) / det;
    match.x_px -= step_x;
    match.y_px -= step_y;
    if (std::hypot(match.x_px - x_px, match.y_px - y_px) > side_px) return match;  // ran away
    if (std::hypot(step_x, step_y) < 1e-3) {
      match.converged = true;
      return match;
    }
  }
  return match;
}

PatchMatch search_patch(const std::vector<float>& patch, int side_px, const Grey& grey, double x_px, double y_px,
                        double radius_px) {
  std::vector<float> wanted = patch;
  PatchMatch best{x_px, y_px, -1, false};
  if (!normalise(wanted)) return {x_px, y_px, 0, false};
  const int radius = static_cast<int>(std::ceil(radius_px));
  for (int oy = -radius; oy <= radius; ++oy)
    for (int ox = -radius; ox <= radius; ++ox) {
      if (std::hypot(ox, oy) > radius_px) continue;
      std::vector<float> seen = cut_patch(grey, x_px + ox, y_px + oy, side_px);
      if (!normalise(seen)) continue;
      const double likeness = product(wanted, seen);
      if (likeness > best.likeness) best = {x_px + ox, y_px + oy, likeness, false};
    }
  return best.likeness < 0 ? best : align_patch(patch, side_px, grey, best.x_px, best.y_px);
}

}  // namespace face::track
