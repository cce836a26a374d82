// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/blend_linear.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.blend_linear", &blend_linear, version{1},
     doc{"Blends the vertices of example poses linearly, for comparison."}, input{"reference", "The mesh at rest"},
     input{"examples", "The same mesh in other poses"}, input{"weights", "One weight per example"},
     output("points", "The vertices"));
