// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/rig.h"

namespace face {

// Directions of a linear space about a mean: what coefficient k adds is coefficient * mode k.
struct LinearSpace {
  std::vector<std::string> names;  // K
  std::vector<float> sigmas;       // K: how far coefficients spread about 0, one standard deviation
  std::vector<Vec3f> modes;        // K x V: offsets at coefficient 1

  std::size_t size() const { return sigmas.size(); }
};

// A morphable model of heads: points = mean + identity + expression, albedo = mean_albedo + albedo. With all expression
// coefficients 0 the face is neutral and its mouth closed.
struct MorphableModel {
  Mesh mean;
  LinearSpace identity;                    // mm
  LinearSpace expression;                  // mm
  LinearSpace albedo;                      // linear reflectance
  std::vector<Vec3f> mean_albedo;          // V, linear reflectance
  std::vector<std::uint32_t> landmarks68;  // Multi-PIE order
  std::vector<LipPair> inner_lips;         // as in Rig
};

}  // namespace face
