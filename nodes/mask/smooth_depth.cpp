// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/smooth_depth.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"

namespace face::mask {
namespace {

// Weights of 2 radius + 1 samples that give the smoothed middle one.
std::vector<double> taps_of(Smoothing smoothing, int radius, int degree) {
  const int length = 2 * radius + 1;
  std::vector<double> taps(static_cast<std::size_t>(length), 0.0);
  if (smoothing == Smoothing::kernels) {
    double sum = 0;
    for (int k = -radius; k <= radius; ++k) {
      const double u = static_cast<double>(k) / (radius + 1);
      sum += taps[static_cast<std::size_t>(k + radius)] = std::pow(1 - u * u, degree);
    }
    for (double& tap : taps) tap /= sum;
    return taps;
  }
  // The value at 0 of the least-squares polynomial: the first row of the pseudo-inverse of the Vandermonde matrix.
  const int columns = std::min(degree, length - 1) + 1;
  Eigen::MatrixXd powers(length, columns);
  for (int k = 0; k < length; ++k)
    for (int c = 0; c < columns; ++c) powers(k, c) = std::pow(static_cast<double>(k - radius) / radius, c);
  const Eigen::MatrixXd inverse = powers.completeOrthogonalDecomposition().pseudoInverse();
  for (int k = 0; k < length; ++k) taps[static_cast<std::size_t>(k)] = inverse(0, k);
  return taps;
}

class Passes {
 public:
  explicit Passes(const SmoothDepthOptions& options) : options_(options) {}

  // All passes over one run of depths.
  void smooth(std::vector<double>& run) {
    const int length = static_cast<int>(run.size());
    const int radius = std::min(static_cast<int>(options_.window_px / 2), (length - 1) / 2);
    if (length < 5) return;
    for (std::int64_t degree = options_.highest_degree; degree >= options_.lowest_degree; --degree) {
      const std::vector<double>& taps = at(radius, static_cast<int>(degree));
      std::vector<double> padded(static_cast<std::size_t>(length + 2 * radius));
      for (int k = 0; k < length; ++k) padded[static_cast<std::size_t>(k + radius)] = run[static_cast<std::size_t>(k)];
      for (int k = 1; k <= radius; ++k) {
        padded[static_cast<std::size_t>(radius - k)] = 2 * run.front() - run[static_cast<std::size_t>(k)];
        padded[static_cast<std::size_t>(radius + length - 1 + k)] =
            2 * run.back() - run[static_cast<std::size_t>(length - 1 - k)];
      }
      std::fill(run.begin(), run.end(), 0.0);
      for (std::size_t t = 0; t < taps.size(); ++t)
        for (std::size_t k = 0; k < run.size(); ++k) run[k] += taps[t] * padded[k + t];
    }
  }

 private:
  const std::vector<double>& at(int radius, int degree) {
    auto& taps = taps_[{radius, degree}];
    if (taps.empty()) taps = taps_of(options_.smoothing, radius, degree);
    return taps;
  }
  const SmoothDepthOptions& options_;
  std::map<std::pair<int, int>, std::vector<double>> taps_;
};

}  // namespace

DepthScan smooth_depth(const DepthScan& scan, const Image* where, const SmoothDepthOptions& options) {
  check_scan(scan, "scan");
  check(options.window_px % 2 == 1, "window_px is ", options.window_px, ", expected an odd number");
  check(options.lowest_degree <= options.highest_degree, "lowest_degree is ", options.lowest_degree,
        ", highest_degree ", options.highest_degree);
  const int width = scan.picture.width, height = scan.picture.height;
  if (where)
    check(where->width == width && where->height == height && where->channels == 1, "where is ", where->width, " x ",
          where->height, " pixels of ", where->channels, " channels, expected ", width, " x ", height, " grey");
  if (where)
    check(where->pixels.size() == scan.depth_mm.size(), "where has ", where->pixels.size(), " values, expected ",
          scan.depth_mm.size(), " for ", width, " x ", height, " pixels");
  DepthScan out = scan;
  Passes passes(options);
  for (int y = 0; y < height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int x = 0; x < width;) {
      int end = x;
      std::vector<double> run;
      while (end < width && scan.depth_mm[row + static_cast<std::size_t>(end)] > 0)
        run.push_back(static_cast<double>(scan.depth_mm[row + static_cast<std::size_t>(end++)]));
      if (!run.empty()) passes.smooth(run);
      for (std::size_t k = 0; k < run.size(); ++k) {
        const std::size_t i = row + static_cast<std::size_t>(x) + k;
        if (!where || where->pixels[i] >= 128) out.depth_mm[i] = static_cast<float>(run[k]);
      }
      x = std::max(end, x + 1);
    }
  }
  return out;
}

}  // namespace face::mask
