// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/speak_path.h"

#include "engine/node.h"
#include "nodes/types/phone_statistics.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::mmm;

NODE(
    "mmm.speak_path", &speak_path, version{1},
    doc{"Turns timed phones into a learned speaker's path: the smoothest one through the Gaussians of the phones, with "
        "lips shut where they have to be."},
    input{"phones", "What is said when"}, input{"statistics", "The speaker, from mmm.refine_speaker"},
    param("rate_hz", &SpeakPathOptions::rate_hz, range{1, 240}, unit{"Hz"}, "Frames per second"),
    param("smoothness", &SpeakPathOptions::smoothness, range{0.0, 1e6}, unit{"1"},
          "How much a fast change costs, at 30 frames per second"),
    param("steps", &SpeakPathOptions::steps, range{1, 100}, unit{"1"}, "Of a frame, at which the path is found"),
    param("hold_closures", &SpeakPathOptions::hold_closures, "Lips stay shut all through P, B and M"),
    output("timeline", "Time of every frame"), output("weights", "Of every frame"));
