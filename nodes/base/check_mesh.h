// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/mesh.h"

namespace face {

// Throws where polygons, parts, vertex colours or texture coordinates do not fit each other: what reads a mesh after it
// needs no further look.
void check_mesh(const Mesh& mesh);

}  // namespace face
