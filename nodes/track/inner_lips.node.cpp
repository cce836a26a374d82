// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/inner_lips.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.inner_lips", &inner_lips, version{1},
     doc{"Finds where the lips part, between the points of their outer edge."}, input{"image", "A frame"},
     input{"landmarks", "Its points, lip_0 to lip_11 among them"},
     param("unlike", &InnerLipsOptions::unlike, range{0.1, 100}, unit{"1"},
           "Deviations from the colours of the lips from which on something is no lip"),
     output("landmarks", "The points, and inner_lip_1 to inner_lip_3 above, inner_lip_5 to inner_lip_7 below"));
