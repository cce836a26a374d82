// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/refine_perspective.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/luma.h"
#include "nodes/base/quantile.h"
#include "nodes/mmm/fit_perspective.h"

namespace face::mmm {
namespace {

using Eigen::Matrix3d;
using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Vector8d = Eigen::Matrix<double, 8, 1>;

struct Grey {
  int width = 0, height = 0;
  std::vector<float> values;

  float at(int x, int y) const { return values[static_cast<std::size_t>(y * width + x)]; }
  // Bilinear; the place lies within.
  float between(double x, double y) const {
    const int left = std::min(static_cast<int>(x), width - 2), top = std::min(static_cast<int>(y), height - 2);
    const auto a = static_cast<float>(x - left), b = static_cast<float>(y - top);
    return (1 - b) * ((1 - a) * at(left, top) + a * at(left + 1, top)) +
           b * ((1 - a) * at(left, top + 1) + a * at(left + 1, top + 1));
  }
};

Grey grey_of(const Image& image) {
  const int width = image.width, height = image.height;
  Grey grey{width, height, {}};
  for (std::size_t p = 0; p < image.pixels.size(); p += 3)
    grey.values.push_back(grey_value<float>(&image.pixels[p], 3));
  Grey across = grey;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      across.values[static_cast<std::size_t>(y * width + x)] =
          (grey.at(std::max(0, x - 1), y) + 2 * grey.at(x, y) + grey.at(std::min(width - 1, x + 1), y)) / 4;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      grey.values[static_cast<std::size_t>(y * width + x)] =
          (across.at(x, std::max(0, y - 1)) + 2 * across.at(x, y) + across.at(x, std::min(height - 1, y + 1))) / 4;
  return grey;
}

struct Pixel {
  int x, y;
};

// Those of the mask whose neighbours lie within the picture.
std::vector<Pixel> counted(const Image* mask, int width, int height) {
  std::vector<Pixel> pixels;
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x)
      if (!mask || mask->pixels[static_cast<std::size_t>((y * width + x) * mask->channels)] >= 128)
        pixels.push_back({x, y});
  return pixels;
}

Matrix as_matrix(const Matrix3d& h) {
  Matrix made{3, 3, {}};
  for (int i = 0; i < 9; ++i) made.values.push_back(h(i / 3, i % 3) / h(2, 2));
  return made;
}

// The frame where the perspective has the reference's pixels; those that lie outside are not seen.
struct Warped {
  Grey grey;
  std::vector<std::uint8_t> seen;
};

void warp(const Grey& frame, const Matrix3d& h, Warped& warped) {
  const int width = frame.width, height = frame.height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double d = h(2, 0) * x + h(2, 1) * y + h(2, 2);
      const double fx = (h(0, 0) * x + h(0, 1) * y + h(0, 2)) / d, fy = (h(1, 0) * x + h(1, 1) * y + h(1, 2)) / d;
      const auto at = static_cast<std::size_t>(y * width + x);
      warped.seen[at] = d > 0 && fx >= 0 && fy >= 0 && fx <= width - 1 && fy <= height - 1;
      warped.grey.values[at] = warped.seen[at] ? frame.between(fx, fy) : 0;
    }
}

}  // namespace

Matrix refine_perspective(const Image& reference, const Image& frame, const Image* mask, const Matrix& start,
                          const RefinePerspectiveOptions& options) {
  const int width = reference.width, height = reference.height;
  const std::vector<Pixel> pixels = counted(mask, width, height);
  if (pixels.size() < 64) return start;
  const Grey before = grey_of(reference), after = grey_of(frame);
  // u = (x - middle) / size, so that all parameters are of one size.
  const double cx = (width - 1) / 2.0, cy = (height - 1) / 2.0, size = std::max(width, height) / 2.0;
  Matrix3d to_unit, h;
  to_unit << 1 / size, 0, -cx / size, 0, 1 / size, -cy / size, 0, 0, 1;
  for (int i = 0; i < 9; ++i) h(i / 3, i % 3) = start.values[static_cast<std::size_t>(i)];
  const Matrix3d from_unit = to_unit.inverse();
  Warped warped{before, std::vector<std::uint8_t>(before.values.size(), 0)};
  double scale = 1e9;
  const auto row = static_cast<std::size_t>(width);
  for (std::int64_t round = 0; round < options.max_rounds; ++round) {
    warp(after, h, warped);
    const std::vector<float>& w = warped.grey.values;
    const auto is_seen = [&](std::size_t p) {
      return warped.seen[p] && warped.seen[p - 1] && warped.seen[p + 1] && warped.seen[p - row] && warped.seen[p + row];
    };
    std::vector<float> sizes;
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
      const auto p = static_cast<std::size_t>(pixels[i].y * width + pixels[i].x);
      if (is_seen(p)) sizes.push_back(std::abs(w[p] - before.values[p]));
    }
    if (sizes.size() < 21) return start;
    const auto usual = static_cast<double>(median(std::move(sizes)));
    scale = std::max(options.least_scale_levels, std::min(1.4826 * usual, scale));
    Matrix8d normal = Matrix8d::Zero();
    Vector8d right = Vector8d::Zero();
    for (const Pixel& pixel : pixels) {
      const auto p = static_cast<std::size_t>(pixel.y * width + pixel.x);
      if (!is_seen(p)) continue;
      const std::vector<float>& b = before.values;
      const double gx = static_cast<double>(w[p + 1] - w[p - 1] + b[p + 1] - b[p - 1]) / 4;
      const double gy = static_cast<double>(w[p + row] - w[p - row] + b[p + row] - b[p - row]) / 4;
      const double residual = static_cast<double>(w[p] - b[p]), q = residual / (2 * scale);
      const double weight = 1 / ((1 + q * q) * (1 + q * q));
      const double u = (pixel.x - cx) / size, v = (pixel.y - cy) / size, along = gx * u + gy * v;
      Vector8d j;
      j << gx * u, gx * v, gx, gy * u, gy * v, gy, -along * u, -along * v;
      normal.selfadjointView<Eigen::Lower>().rankUpdate(j, weight);
      right -= weight * residual * j;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix8d> parts(normal);
    // A direction along which the pictures do not change cannot be told; both limits are far above rounding and far
    // below what a face has.
    const double least = std::max(1e-7 * parts.eigenvalues()[7], 1e-6 * static_cast<double>(pixels.size()));
    if (!(parts.eigenvalues()[0] > least)) return start;
    const Vector8d step_px =
        parts.eigenvectors() * (parts.eigenvectors().transpose() * right).cwiseQuotient(parts.eigenvalues()).eval();
    const Vector8d d = step_px / size;
    Matrix3d step;
    step << 1 + d[0], d[1], d[2], d[3], 1 + d[4], d[5], d[6], d[7], 1;
    h = h * from_unit * step * to_unit;
    h /= h(2, 2);
    if (!h.allFinite()) return start;
    // A thousandth of a pixel at the picture's edge.
    if (step_px.cwiseAbs().maxCoeff() < 1e-3) break;
  }
  const Matrix found = as_matrix(h);
  for (const double x : {0.0, width - 1.0})
    for (const double y : {0.0, height - 1.0}) {
      const auto from = map_point(start, x, y), to = map_point(found, x, y);
      if (!(std::hypot(from[0] - to[0], from[1] - to[1]) <= 8)) return start;
    }
  return found;
}

}  // namespace face::mmm
