// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_key_frames.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;

NODE("trajectory.speak_key_frames", &speak_key_frames, version{1},
     doc{"Speech by key frames with cosine acceleration, one viseme per phone, as Blanz, Basso, Poggio and Vetter make "
         "it."},
     input{"phones", "What is said when"}, input{"visemes", "What the face does for every phone"},
     param("rate_hz", &SpeakKeyFramesOptions::rate_hz, range{1.0, 1000.0}, unit{"Hz"}, "Frames per second"),
     output("timeline", "When every frame is shown"), output("weights", "52 ARKit weights of every frame"));
