// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/raise_jaw.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.raise_jaw", &raise_jaw, version{5},
     doc{"Landmarks of a mouth at rest, from those of a mouth that is shut over a hanging jaw, as in the middle of "
         "speech."},
     input{"rig", "The head"},
     input{"landmarks", "The speaker's landmarks in every frame, of a head that stands still"},
     input{"rest", "Those of a shut mouth, as track.find_rest finds it"},
     input{"visemes", "Which weights go together in speech; without it every shape is as likely as another"},
     param("highest_share", &RaiseJawOptions::highest_share, range{0.0, 1.0}, unit{"1"},
           "Share of the frames that may have the jaw above the rest"),
     param("most", &RaiseJawOptions::most, range{0.0, 1.0}, unit{"1"},
           "How far the jaw is raised at most, in weights of jawOpen"),
     param("max_lost", &RaiseJawOptions::max_lost, range{0, 1000}, unit{"1"},
           "Frames that lost more landmarks do not count"),
     param("rest_frames", &RaiseJawOptions::rest_frames, range{1, 100000}, unit{"1"},
           "So many frames in a row with the mouth as it is in rest are a rest; nothing is raised where there are some"),
     output("raised", "The landmarks at rest"));
