// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>

namespace face {

inline constexpr std::size_t normal_harmonics_count = 9;

// The spherical harmonics of a unit normal up to the second order, without their constants. What light from everywhere
// does to a surface is all but a sum of them (Basri and Jacobs, Lambertian Reflectance and Linear Subspaces, PAMI
// 2003).
constexpr std::array<double, normal_harmonics_count> normal_harmonics(double x, double y, double z) {
  return {1, x, y, z, x * y, x * z, y * z, x * x - y * y, 3 * z * z - 1};
}

}  // namespace face
