// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/reconstruct.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.reconstruct", &reconstruct, version{1},
     doc{"Blends example poses by rotations and stretches of their triangles into the vertices of one frame."},
     input{"space", "The examples, from meshik.prepare"}, input{"weights", "One weight per example"},
     output("points", "The vertices"));
