// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "nodes/base/srgb.h"
#include "nodes/types/face_fit.h"

namespace face::model {

// Rec. 709 weights: what contrast mixes colour with.
inline constexpr std::array<double, 3> luma = {0.2126, 0.7152, 0.0722};

// Linear light on a surface whose normal has this cosine with the light's direction.
inline double light_at(const FaceLight& light, std::size_t channel, double cosine) {
  return static_cast<double>(light.ambient[channel]) +
         static_cast<double>(light.parallel[channel]) * std::max(0.0, cosine);
}

// What skin mirrors of parallel light, in Blinn's lobes (Models of Light Reflection for Computer Synthesized Pictures,
// 1977): the cosine between the normal and the half of the directions to light and eye, to the powers 8 and 32. Made
// skin has a lobe between the two.
inline constexpr std::size_t lobe_count = 2;
struct Lobes {
  std::array<double, lobe_count> value{}, slope{};  // slope: by the cosine
};

inline Lobes lobes_at(double cosine) {
  Lobes lobes;
  if (cosine <= 0) return lobes;
  double power = cosine;
  for (int i = 0; i < 3; ++i) power *= power;
  lobes.value[0] = power;
  lobes.slope[0] = 8 * power / cosine;
  for (int i = 0; i < 2; ++i) power *= power;
  lobes.value[1] = power;
  lobes.slope[1] = 32 * power / cosine;
  return lobes;
}

// The picture's sRGB values of the sRGB values of light, by the formula at FaceLight.
inline std::array<double, 3> mixed(const FaceLight& light, const std::array<double, 3>& e) {
  std::array<double, 3> value;
  double grey = 0;
  for (std::size_t c = 0; c < 3; ++c) grey += luma[c] * e[c];
  for (std::size_t c = 0; c < 3; ++c)
    value[c] = light.gain[c] * (light.contrast * e[c] + (1.0 - light.contrast) * grey) + light.offset[c];
  return value;
}

// And of a lit albedo.
inline std::array<double, 3> shown(const FaceLight& light, const std::array<double, 3>& lit) {
  return mixed(light, {srgb_of(lit[0]), srgb_of(lit[1]), srgb_of(lit[2])});
}

// The lit albedo that is shown so: the exact inverse. Gains and contrast must not be 0.
inline std::array<double, 3> lit_of(const FaceLight& light, const std::array<double, 3>& value) {
  std::array<double, 3> mixed, lit;
  double grey = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    mixed[c] = (value[c] - light.offset[c]) / light.gain[c];
    grey += luma[c] * mixed[c];  // mixing keeps the luminance: the weights sum to 1
  }
  for (std::size_t c = 0; c < 3; ++c) lit[c] = linear_of((mixed[c] - (1.0 - light.contrast) * grey) / light.contrast);
  return lit;
}

}  // namespace face::model
