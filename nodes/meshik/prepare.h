// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "engine/port.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_space.h"

namespace face::meshik {

// Takes example poses apart for MeshIK (Sumner, Zwicker, Gotsman, Popovic, Mesh-Based Inverse Kinematics, SIGGRAPH
// 2005; Animating Lip-Sync Speech Faces, section 3): per triangle the polar parts of the deformation from the reference
// to each example, and the Cholesky factor of the system that turns blended gradients into vertices. The fourth vertex
// of each triangle, which the papers solve for as well, is eliminated: for given edges its best place makes the
// gradient along the normal exact, so that what is left is the gradient within the triangle's plane. V unknowns instead
// of V + F, and the same solution.
// Differs from the papers: triangles of the reference without area are left out.
// reference_mm: 3 V, triangles: 3 F, examples_mm: K x 3 V. Throws where sizes differ or a number is not finite.
MeshSpace prepare_triangles(const std::vector<double>& reference_mm, const std::vector<std::uint32_t>& triangles,
                            const std::vector<std::vector<double>>& examples_mm);

// The same for meshes; the examples have the reference's vertices and polygons (only its own polygons are looked at).
MeshSpace prepare(const Mesh& reference, const engine::Seq<Mesh>& examples);

}  // namespace face::meshik
