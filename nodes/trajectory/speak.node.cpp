// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;
NODE("trajectory.speak", &speak, version{1},
     doc{"Turns timed phones into the 52 ARKit weights of every frame: smooth, coarticulated, with lips that meet in "
         "every P B "
         "M and touch the teeth in every F V, judged in mm on the rig that will be animated."},
     input{"phones", "What is said when; stops split into closure and release"},
     input{"visemes", "What the face does for every phone"}, input{"rig", "The head whose lips must meet"},
     param("rate_hz", &SpeakOptions::rate_hz, range{25, 120}, unit{"Hz"}, "Frames per second"),
     param("smoothness", &SpeakOptions::smoothness, range{0.5, 100}, unit{"1"},
           "How much a fast change costs (lambda of the paper, at 30 frames per second); more is smoother and blurs "
           "phones"),
     param("strength", &SpeakOptions::strength, range{0, 1.5}, unit{"1"},
           "Multiplies the viseme targets; below 1 mumbles, above 1 over-articulates"),
     param("normalise", &SpeakOptions::normalise,
           {{"none", Normalise::none}, {"utterance", Normalise::utterance}, {"duration", Normalise::duration}},
           "How a phone's length changes its pull: not, as in the paper, or so that short phones pull as much as long "
           "ones"),
     output("weights", "52 weights per frame, ARKit order"),
     output("timeline", &SpeakResult::timeline, "Time of every frame"),
     output("worst_closure_mm", &SpeakResult::worst_closure_mm, "Largest of the smallest lip gaps of P B M"),
     output("deepest_overlap_mm", &SpeakResult::deepest_overlap_mm, "How far the lips run into each other, at most"),
     output("worst_teeth_mm", &SpeakResult::worst_teeth_mm,
            "Largest of the smallest distances of lower lip to upper teeth of F V"),
     output("contact_count", &SpeakResult::contact_count, "Closures, labiodentals and open vowels asked for"),
     output("missed_count", &SpeakResult::missed_count, "Of these, those that the rig could not make"));
