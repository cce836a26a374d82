// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/stack_motion.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.stack_motion", &stack_motion, version{1},
     doc{"A motion over time as one matrix, one row per frame: the rotation's rows, then the translation in mm."},
     input{"motion", "Rigid motion of every frame"}, output("matrix", "T x 12"));
