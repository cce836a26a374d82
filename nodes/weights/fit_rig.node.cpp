// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/fit_rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::weights;

NODE("weights.fit_rig", &fit_rig, version{1},
     doc{"Weights of a head's own ARKit shapes for an animation of its vertices, for other heads and for editing."},
     input{"rig", "The head"}, input{"points", "The vertices of every frame"},
     param("restraint", &FitRigOptions::restraint, range{1e-9, 1.0}, unit{"1"},
           "What the square of a weight costs, as a share of what an average shape moves"),
     output("weights", "52 weights of every frame, each 0 to 1"),
     output("rms_mm", &FitRigResult::rms_mm, "What the shapes do not explain, root mean square"),
     output("largest_mm", &FitRigResult::largest_mm, "The same, of any vertex in any frame"));
