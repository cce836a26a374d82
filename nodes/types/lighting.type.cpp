// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/lighting.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Lighting, "lighting", codec_version{1}, doc{"One parallel and one ambient light, and a camera's colours."},
     field<&Lighting::ambient>(), field<&Lighting::parallel>(), field<&Lighting::towards_light>(),
     field<&Lighting::contrast>(), field<&Lighting::gain>(), field<&Lighting::offset>());
