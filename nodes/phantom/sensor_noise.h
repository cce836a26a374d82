// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace face::phantom {

// The final mix of SplitMix64 (see nodes/base/random.h): a hash of a counter, so that every pixel has its random number
// whatever the order in which pixels are looked at.
inline std::uint64_t mixed_bits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

// The noise of one frame of a sensor: another one for every seed, frame and purpose (such as 0 for depth, 1 for grey).
class PixelNoise {
 public:
  // id: the frame's; frames of the same id and seed have the same noise.
  PixelNoise(std::int64_t seed, const std::string& id, std::uint64_t purpose);

  std::uint64_t bits(std::uint64_t pixel) const { return mixed_bits(key_ + pixel * 0x9e3779b97f4a7c15ull); }
  // Uniform in [0, 1).
  float uniform(std::uint64_t pixel) const { return static_cast<float>(bits(pixel) >> 40) * 0x1.0p-24f; }
  // Standard normal, by Box and Muller.
  float normal(std::uint64_t pixel) const;

 private:
  std::uint64_t key_;
};

// Standard normal numbers from 12 random bits: the quantiles of 4096 equal shares (inverse distribution function by
// Acklam, An algorithm for computing the inverse normal cumulative distribution function, 2003), scaled to variance 1.
// For pictures of 8 bits, where 10 times the speed counts for more than tails beyond 3.7 sigma.
class NormalTable {
 public:
  NormalTable();
  float operator[](std::uint64_t twelve_bits) const { return values_[twelve_bits & 4095]; }

 private:
  std::vector<float> values_;
};

}  // namespace face::phantom
