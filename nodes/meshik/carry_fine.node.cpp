// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/carry_fine.h"

#include "engine/node.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/mesh_space.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.carry_fine", &carry_fine, version{1},
     doc{"Brings a frame that was solved on a simplified head to the whole one."},
     input{"space", "The whole head's examples, from meshik.prepare"},
     input{"simple_space", "The simplified head's, from the same"},
     input{"binding", "Where the whole head's vertices lie on it, from meshik.simplify"},
     input{"weights", "The frame's weights, from meshik.solve"}, input{"points", "The simplified head's vertices"},
     output("points", "The whole head's vertices"));
