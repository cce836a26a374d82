// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_head.h"
#include "engine/node.h"
#include "nodes/types/rig.h"

using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.make_head", &make_head, version{1},
     doc{"The embedded head: a stylised human head made by code, with mouth, teeth, tongue, eyes and all 52 ARKit "
         "shapes. "
         "A rig for machines that have no other."},
     param("with_hair", &MakeHeadOptions::with_hair, "Adds a short head of hair"),
     output("head", "The head and its shapes, in mm"));
