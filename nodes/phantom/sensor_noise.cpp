// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/sensor_noise.h"

#include <array>
#include <cmath>
#include <numbers>

namespace face::phantom {
namespace {

double normal_quantile(double p) {
  constexpr std::array<double, 6> a = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                                       1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr std::array<double, 5> b = {-5.447609879822406e+01, 1.615858368580409e+02, -1.556989798598866e+02,
                                       6.680131188771972e+01, -1.328068155288572e+01};
  constexpr std::array<double, 6> c = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                                       -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr std::array<double, 4> d = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                                       3.754408661907416e+00};
  constexpr double tail = 0.02425;
  if (p > 0.5) return -normal_quantile(1 - p);
  if (p < tail) {
    const double q = std::sqrt(-2 * std::log(p));
    return (((((c[0] * q + c[1]) * q + c[2]) * q + c[3]) * q + c[4]) * q + c[5]) /
           ((((d[0] * q + d[1]) * q + d[2]) * q + d[3]) * q + 1);
  }
  const double q = p - 0.5, r = q * q;
  return (((((a[0] * r + a[1]) * r + a[2]) * r + a[3]) * r + a[4]) * r + a[5]) * q /
         (((((b[0] * r + b[1]) * r + b[2]) * r + b[3]) * r + b[4]) * r + 1);
}

}  // namespace

PixelNoise::PixelNoise(std::int64_t seed, const std::string& id, std::uint64_t purpose) {
  std::uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  key_ = mixed_bits(mixed_bits(static_cast<std::uint64_t>(seed) * 0x9e3779b97f4a7c15ull + hash) + purpose);
}

float PixelNoise::normal(std::uint64_t pixel) const {
  const std::uint64_t random = bits(pixel);
  const float u = static_cast<float>((random >> 40) + 1) * 0x1.0p-24f;
  const float v = static_cast<float>((random >> 16) & 0xffffff) * 0x1.0p-24f;
  return std::sqrt(-2.0f * std::log(u)) * std::cos(2.0f * std::numbers::pi_v<float> * v);
}

NormalTable::NormalTable() : values_(4096) {
  double squares = 0;
  for (std::size_t i = 0; i < 2048; ++i) {
    const double quantile = normal_quantile((static_cast<double>(i) + 0.5) / 4096);
    values_[i] = static_cast<float>(quantile);
    values_[4095 - i] = static_cast<float>(-quantile);
    squares += 2 * quantile * quantile;
  }
  const auto scale = static_cast<float>(1 / std::sqrt(squares / 4096));
  for (float& value : values_) value *= scale;
}

}  // namespace face::phantom
