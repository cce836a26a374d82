// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/sculpt_keys.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.sculpt_keys", &sculpt_keys, version{2},
     doc{"Makes a mesh for every key shape of a speaker from a rig, without an artist."}, input{"rig", "The head"},
     input{"key_shapes", "The speaker's key shapes"}, input{"neutral", "The speaker's landmarks at rest"},
     param("restraint", &SculptKeysOptions::restraint, range{1e-9, 10}, unit{"1"},
           "Pulls weights to 0, as a share of what an average shape moves"),
     output("key_meshes", "The head in every key shape"), output("rig_weights", "The rig's weights of each"),
     output("reference", &SculptKeysResult::reference, "The head at rest"),
     output("mm_per_px", &SculptKeysResult::mm_per_px, "How large a pixel of the pictures is on the rig"),
     output("rms_mm", &SculptKeysResult::rms_mm,
            "Root mean square of how far landmarks are from where they should be"));
