// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/posed_rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.posed_rig", &posed_rig, version{1}, cheap{}, doc{"A head as its vertices are in one frame."},
     input{"rig", "The head"}, input{"points", "Its vertices in the frame"}, output("posed", "The head, so posed"));
