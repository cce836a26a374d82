// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/keep_detail.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "nodes/base/luma.h"

namespace face::mmm {
namespace {

constexpr float binomial[5] = {1.0f / 16, 4.0f / 16, 6.0f / 16, 4.0f / 16, 1.0f / 16};
constexpr int window_radius_px = 4;

using Values = std::vector<float>;

std::size_t index(int x, int y, int width) { return static_cast<std::size_t>(y * width + x); }

Values brightness(const Values& rgb) {
  Values grey(rgb.size() / 3);
  for (std::size_t p = 0; p < grey.size(); ++p) grey[p] = grey_value<float>(&rgb[3 * p], 3);
  return grey;
}

// The edge goes on. channels side by side.
Values smooth(const Values& values, int width, int height, int channels) {
  Values across(values.size()), both(values.size());
  const auto n = static_cast<std::size_t>(channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t c = 0; c < n; ++c) {
        float sum = 0;
        for (int k = -2; k <= 2; ++k)
          sum += binomial[k + 2] * values[n * index(std::clamp(x + k, 0, width - 1), y, width) + c];
        across[n * index(x, y, width) + c] = sum;
      }
  for (int y = 0; y < height; ++y)
    for (int k = -2; k <= 2; ++k) {
      const float* from = &across[n * index(0, std::clamp(y + k, 0, height - 1), width)];
      float* to = &both[n * index(0, y, width)];
      for (std::size_t i = 0; i < n * static_cast<std::size_t>(width); ++i) to[i] += binomial[k + 2] * from[i];
    }
  return both;
}

// Means over windows that end with the picture.
Values window_mean(const Values& values, int width, int height) {
  std::vector<double> sums(static_cast<std::size_t>((width + 1) * (height + 1)), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      sums[index(x + 1, y + 1, width + 1)] = static_cast<double>(values[index(x, y, width)]) +
                                             sums[index(x, y + 1, width + 1)] + sums[index(x + 1, y, width + 1)] -
                                             sums[index(x, y, width + 1)];
  Values mean(values.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int left = std::max(0, x - window_radius_px), right = std::min(width, x + window_radius_px + 1);
      const int top = std::max(0, y - window_radius_px), bottom = std::min(height, y + window_radius_px + 1);
      const double sum = sums[index(right, bottom, width + 1)] - sums[index(left, bottom, width + 1)] -
                         sums[index(right, top, width + 1)] + sums[index(left, top, width + 1)];
      mean[index(x, y, width)] = static_cast<float>(sum / ((right - left) * (bottom - top)));
    }
  return mean;
}

Values energy_of(const Values& rgb, int width, int height) {
  Values grey = brightness(rgb);
  const Values low = smooth(grey, width, height, 1);
  for (std::size_t p = 0; p < grey.size(); ++p) grey[p] = (grey[p] - low[p]) * (grey[p] - low[p]);
  return grey;
}

double sum_of(const Values& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum;
}

}  // namespace

double detail_energy(const std::vector<float>& values, int width, int height) {
  return sum_of(energy_of(values, width, height));
}

void keep_detail(std::vector<float>& mixed, const std::vector<MixedPicture>& pictures, int width, int height,
                 double noise_level, double most) {
  Values wanted(mixed.size() / 3, 0);
  double sum = 0, squares = 0;
  for (const MixedPicture& picture : pictures) {
    sum += picture.share, squares += picture.share * picture.share;
    const Values energy = energy_of(picture.values, width, height);
    // A picture that was brought to another shape has lost detail by interpolation: about as much everywhere.
    const double now = sum_of(energy), lost = now > 0 && picture.energy > 0 ? picture.energy / now : 1;
    const auto share = static_cast<float>(picture.share * std::clamp(lost, 1.0, 1.5));
    for (std::size_t p = 0; p < wanted.size(); ++p) wanted[p] += share * energy[p];
  }
  if (!(sum > 0)) return;
  wanted = window_mean(wanted, width, height);
  // Of white noise of variance 1 what the binomial leaves: (1 - b)^2 + the squares of all other weights; brightness
  // takes less of three independent channels.
  double power = 0;
  for (const float w : binomial) power += static_cast<double>(w) * static_cast<double>(w);
  const double middle = static_cast<double>(binomial[2]) * static_cast<double>(binomial[2]);
  double channels = 0;
  for (const double weight : luma_weights) channels += weight * weight;
  const double noise = noise_level * noise_level * (1 - 2 * middle + power * power) * channels;
  Values most_gain(wanted.size(), static_cast<float>(most));
  // Detail that is added has less detail than that: twice leaves little of the gap.
  for (int round = 0; round < 2; ++round) {
    const Values found = window_mean(energy_of(mixed, width, height), width, height);
    const Values low = smooth(mixed, width, height, 3);
    for (std::size_t p = 0; p < wanted.size(); ++p) {
      // The noise that the mean has lost is not wanted back. A quarter of a grey level is nothing to be made stronger.
      const double lost = noise * (1 - squares / (sum * sum));
      const double target = std::max(0.0, static_cast<double>(wanted[p]) / sum - lost) + 1.0 / 16;
      const double now = static_cast<double>(found[p]) + 1.0 / 16;
      const float gain = std::clamp(static_cast<float>(std::sqrt(target / now)), 1.0f, most_gain[p]);
      for (std::size_t c = 0; c < 3; ++c) mixed[3 * p + c] += (gain - 1) * (mixed[3 * p + c] - low[3 * p + c]);
      most_gain[p] /= gain;
    }
  }
}

}  // namespace face::mmm
