// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/mesh_still.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.mesh_still", &mesh_still, version{1}, doc{"Shows a mesh from the front and from its left."},
     input{"mesh", "A mesh"}, output("image", "The pictures side by side"));
