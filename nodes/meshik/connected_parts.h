// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace face::meshik {

// Number of the connected part of every vertex, in the order of their first vertices. A vertex without a triangle is a
// part of its own.
std::vector<std::uint32_t> connected_parts(std::size_t vertex_count, const std::vector<std::uint32_t>& triangles);

}  // namespace face::meshik
