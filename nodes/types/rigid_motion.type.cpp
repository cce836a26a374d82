// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/rigid_motion.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(RigidMotion, "rigid_motion", codec_version{1}, doc{"A rotation and a translation."},
     field<&RigidMotion::rotation>(), field<&RigidMotion::translation_mm>());
