// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/lip_colours.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.lip_colours", &lip_colours, version{1},
     doc{"What a frame shows of the lips, for the nodes that tell from it whether and how far they are apart."},
     input{"image", "A frame"}, input{"landmarks", "Its points, lip_0 to lip_11 among them"},
     input{"light", "How the light has changed since the first frame, of track.klt"},
     output("colours", &LipColoursResult::colours,
            "Red and blue to green (logarithms) and brightness (0 to 1) of 64 places on each of three lines across the "
            "mouth"),
     output("contrast", &LipColoursResult::contrast, "Contrast of the face in each, 1 in an ungraded film"));
