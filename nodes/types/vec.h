// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace face {

// Plain vectors for value types: Eigen stays out of headers (algorithms map these onto Eigen::Vector3f in their .cpp).
using Vec2f = std::array<float, 2>;
using Vec3f = std::array<float, 3>;

}  // namespace face
