// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/warp_perspective.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.warp_perspective", &warp_perspective, version{1}, cheap{},
     doc{"Holds a head still, or gives it its motion back."}, input{"frame", "The picture"},
     input{"perspective", "Where the head is in it, from mmm.normalise"},
     param("inverse", &WarpPerspectiveOptions::inverse, "Gives a head that was held still its motion back"),
     output("steady", "The picture with the head where it is on the reference"));
