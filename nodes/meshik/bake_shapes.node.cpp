// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/bake_shapes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.bake_shapes", &bake_shapes, version{2},
     doc{"Makes blend shapes and their weights of an animation of vertices, for pictures and glTF."},
     input{"rig", "The head"}, input{"points", "The vertices of every frame"},
     param("tolerance_mm", &BakeShapesOptions::tolerance_mm, range{0.0, 100.0}, unit{"mm"},
           "As many shapes as leave no vertex farther off"),
     param("max_shapes", &BakeShapesOptions::max_shapes, range{1, 1000}, unit{"1"}, "But no more than these",
           inert{"short animations need fewer"}),
     param("examined", &BakeShapesOptions::examined, range{1, 2000}, unit{"1"},
           "Frames at most, evenly spread, that the shapes are found from"),
     output("rig", &BakeShapesResult::rig, "The head with these shapes in place of its own"),
     output("weights", "Weights of every frame"),
     output("rms_mm", &BakeShapesResult::rms_mm, "What the shapes do not explain, root mean square"),
     output("largest_mm", &BakeShapesResult::largest_mm, "The same, of any vertex in any frame"));
