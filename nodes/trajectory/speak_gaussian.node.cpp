// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_gaussian.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;

NODE("trajectory.speak_gaussian", &speak_gaussian, version{2},
     doc{"Turns timed phones into a trained speaker's animation: the smoothest path through the Gaussians of the "
         "phones."},
     input{"phones", "What is said when"}, input{"statistics", "The speaker, from trajectory.train_phones"},
     param("rate_hz", &SpeakGaussianOptions::rate_hz, range{10, 240}, unit{"Hz"}, "Frames per second"),
     param("smoothness", &SpeakGaussianOptions::smoothness, range{0, 1e6}, unit{"1"},
           "How much a fast change costs (lambda of the paper, at 30 frames per second)"),
     param("covariance", &SpeakGaussianOptions::covariance,
           {{"diagonal", CovarianceUse::diagonal}, {"full", CovarianceUse::full}},
           "Whether parameters that move together in training do so here"),
     param("normalise", &SpeakGaussianOptions::normalise,
           {{"none", Normalise::none}, {"utterance", Normalise::utterance}, {"duration", Normalise::duration}},
           "How a phone's length changes its pull"),
     param("closures", &SpeakGaussianOptions::closures,
           {{"free", Closures::free}, {"trained", Closures::trained}, {"rest", Closures::rest}},
           "Whether the middle of every P B M is held exactly: free: no, as published; trained: where training had it; "
           "rest: at 0, for parameters that count from the shut mouth"),
     param(
         "closing_s", &SpeakGaussianOptions::closing_s, range{0, 1}, unit{"s"},
         "With closures at rest: how long before a closure lips begin to shut, and how long after it they have parted"),
     output("timeline", "Time of every frame"), output("weights", "Animation parameters of every frame"));
