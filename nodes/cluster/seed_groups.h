// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/matrix.h"

namespace face::cluster {

// `count` different points to begin with, each drawn with a probability that grows with its squared distance to those
// drawn before (Arthur and Vassilvitskii, k-means++: The Advantages of Careful Seeding, SODA 2007). Throws where there
// are fewer points.
std::vector<std::size_t> seed_groups(const Matrix& points, std::size_t count, std::uint64_t seed);

}  // namespace face::cluster
