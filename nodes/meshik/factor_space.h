// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/types/mesh_space.h"

namespace face::meshik {

// Fills in the factor of G'G, the system that turns gradients into vertices, from triangles, gradients and component.
// Cholesky with approximate minimum degree ordering; the first vertex of every part is pinned.
void factor_space(MeshSpace& space);

// Throws where the parts of a space do not fit together, as those that prepare() makes do.
void check_space(const MeshSpace& space);

// Vertices of the factor: all but the pinned ones.
std::size_t free_count(const MeshSpace& space);

// x: free_count x 4, in the factor's order: three right-hand sides side by side and one place unused.
void solve_lower(const MeshSpace& space, double* x);      // L x = b
void solve_transpose(const MeshSpace& space, double* x);  // L' x = b

// The same for many right-hand sides in single precision, for the Hessian: x: free_count x width, width a multiple of
// 8. Quick where most of x is 0.
void solve_lower_wide(const MeshSpace& space, float* x, std::size_t width);

}  // namespace face::meshik
