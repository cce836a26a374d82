// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/inner_lips.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.inner_lips", &inner_lips, version{9},
     doc{"Finds where the lips part, between the points of their outer edge."},
     input{"colours", "What a frame shows of the lips, of track.lip_colours"},
     input{"contrast", "Contrast of its face, of the same node"},
     input{"landmarks", "Its points, lip_0 to lip_11 among them"},
     input{"rest", "This node's points of the shut mouth: says how thick the lips are"},
     input{"depths_px", "How far rest's points are towards the viewer, of meshik.landmark_depths"},
     input{"head", "The head's pose since rest, of track.klt"},
     param("unlike", &InnerLipsOptions::unlike, range{0.1, 100}, unit{"1"},
           "Deviations from the colours of the lips from which on something is no lip"),
     param("thickness_deviation", &InnerLipsOptions::thickness_deviation, range{0.01, 10}, unit{"1"},
           "How much a lip's thickness varies, as a share of what is expected", inert{"without a mouth at rest"}),
     param("thickening", &InnerLipsOptions::thickening, range{0, 10}, unit{"1"},
           "Power of the mouth's narrowing that lips grow thicker by", inert{"without a mouth at rest"}),
     param("evidence", &InnerLipsOptions::evidence, range{0, 1000}, unit{"1"}, "What a picture says against it",
           inert{"without a mouth at rest"}),
     output("landmarks", "The points, and inner_lip_1 to inner_lip_3 above, inner_lip_5 to inner_lip_7 below"));
