// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/render/mesh_still.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.rig_still", &rig_still, version{1},
     doc{"Shows a head at rest from the front and from its left, and with an open, smiling mouth."},
     input{"rig", "Head and its blend shapes"}, output("image", "The pictures side by side"));
