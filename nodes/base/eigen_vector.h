// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <Eigen/Core>
#include <array>

#include "nodes/types/vec.h"

namespace face {

// Plain vectors of value types as Eigen's, and back; for .cpp files.
inline Eigen::Vector3d vector_of(const Vec3f& v) { return {v[0], v[1], v[2]}; }
inline Eigen::Vector3d vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
inline std::array<double, 3> array_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
inline Vec3f float_of(const Eigen::Vector3d& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace face
