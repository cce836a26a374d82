// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/prepare.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE(
    "meshik.prepare", &prepare, version{2},
    doc{"Takes example poses of a mesh apart into rotations and stretches of its triangles, for meshik.reconstruct and "
        "meshik.solve."},
    input{"reference", "The mesh at rest"}, input{"examples", "The same mesh in other poses"},
    output("space", "What the examples span"));
