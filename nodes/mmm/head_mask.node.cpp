// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/head_mask.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.head_mask", &head_mask, version{1},
     doc{"Where a head moves as a whole: without eyes, brows, mouth and chin. By boxes, or by landmarks."},
     input{"frame", "A picture, for its size"},
     input{"landmarks", "The 68 of Multi-PIE, or a clip's; in place of the boxes"},
     param("head", &HeadMaskOptions::head, range{0.0, 1.0}, unit{"1"},
           "The head's box: left, top, right, bottom as shares; an ellipse fills it",
           inert{"landmarks take the place of the boxes"}),
     param("eyes", &HeadMaskOptions::eyes, range{0.0, 1.0}, unit{"1"}, "The box of eyes and brows, left out",
           inert{"landmarks take the place of the boxes"}),
     param("mouth", &HeadMaskOptions::mouth, range{0.0, 1.0}, unit{"1"}, "The box of mouth and chin, left out",
           inert{"landmarks take the place of the boxes"}),
     output("mask", "White where the head moves as a whole"));
