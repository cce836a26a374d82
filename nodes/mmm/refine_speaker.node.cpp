// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/refine_speaker.h"

#include "engine/node.h"
#include "nodes/types/phone_statistics.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.refine_speaker", &refine_speaker, version{2},
     doc{"Trains the means of a speaker's phones so that the spoken path comes near the frames."},
     input{"weights", "Of every frame, empty where there are none"}, input{"timeline", "When the frames are shown"},
     input{"phones", "What is said"}, input{"statistics", "From trajectory.train_phones on the same"},
     param("smoothness", &RefineSpeakerOptions::smoothness, range{0.0, 1e6}, unit{"1"},
           "That of the paths that are spoken with it"),
     param("steps", &RefineSpeakerOptions::steps, range{1, 100}, unit{"1"}, "As these have them for every frame"),
     param("hold_closures", &RefineSpeakerOptions::hold_closures, "As these hold them"),
     param("restraint", &RefineSpeakerOptions::restraint, range{0.0, 1e6}, unit{"1"},
           "Frames that a phone's plain mean counts for"),
     output("statistics", "The same with other means"));
