// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/render/points_still.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.landmarks_still", &landmarks_still, version{1},
     doc{"Shows named points without their picture: green dots where valid, red rings where lost."},
     input{"landmarks", "Points of a picture"}, output("image", "The points"));
