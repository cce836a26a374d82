// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/flow_still.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.flow_still", &flow_still, version{1}, doc{"Shows a flow in colours: hue is direction, colour is length."},
     input{"flow", "Displacements"}, output("image", "The picture"));
