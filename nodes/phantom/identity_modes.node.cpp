// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/identity_modes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.identity_modes", &identity_modes, version{1},
     doc{"Directions in which persons differ, for the embedded head: skull, jaw, nose, lips, eyes, ears, ..., each at "
         "one standard deviation."},
     param("with_hair", &MakeHeadOptions::with_hair, "As in phantom.make_head"),
     output("modes", "Offsets of the head's vertices, in mm"));
