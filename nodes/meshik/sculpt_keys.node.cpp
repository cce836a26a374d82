// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/sculpt_keys.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.sculpt_keys", &sculpt_keys, version{7},
     doc{"Makes a mesh for every key shape of a speaker from a rig, without an artist."}, input{"rig", "The head"},
     input{"key_shapes", "The speaker's key shapes"}, input{"neutral", "The speaker's landmarks at rest"},
     input{"visemes", "Which weights go together in speech; without it every shape is as likely as another"},
     param("restraint", &SculptKeysOptions::restraint, range{1e-9, 10}, unit{"1"},
           "Without visemes: pulls weights to 0, as a share of what an average shape moves",
           inert{"counts where there are no visemes"}),
     param("variety", &SculptKeysOptions::variety, range{0.01, 100}, unit{"1"},
           "How far the speaker goes beyond the visemes"),
     param("common_share", &SculptKeysOptions::common_share, range{0, 1}, unit{"1"},
           "How much of that is what all visemes have in common; 1 = no viseme by itself"),
     param("own_deviation", &SculptKeysOptions::own_deviation, range{1e-4, 1}, unit{"1"},
           "How far a weight may go beside what the visemes have in common"),
     param("landmark_error_mm", &SculptKeysOptions::landmark_error_mm, range{0.01, 100}, unit{"mm"},
           "Error of a coordinate of a landmark; more trusts the visemes more"),
     param("gap_error_mm", &SculptKeysOptions::gap_error_mm, range{0.01, 100}, unit{"mm"},
           "Error of how far inner lips are apart; less makes mouths as open as they were tracked"),
     output("key_meshes", "The head in every key shape"), output("rig_weights", "The rig's weights of each"),
     output("reference", &SculptKeysResult::reference, "The head at rest"),
     output("mm_per_px", &SculptKeysResult::mm_per_px, "How large a pixel of the pictures is on the rig"),
     output("rms_mm", &SculptKeysResult::rms_mm,
            "Root mean square of how far landmarks are from where they should be"));
