// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/mouth_opening.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.mouth_opening", &mouth_opening, version{5},
     doc{"How much between the outer edges of the lips is not as red as lips: teeth and hollow."},
     input{"colours", "What a frame shows of the lips, of track.lip_colours"},
     input{"landmarks", "Its points, lip_0 to lip_11 among them"},
     output("opening", "Size of it, in usual widths of a mouth; -1 where it is not seen"));
