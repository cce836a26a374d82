// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/check_labels.h"

#include "engine/node.h"
#include "nodes/types/matrix.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.check_labels", &check_labels, version{2},
     doc{"Refuses labels that are not those of a video, and names the first that does not fit."},
     input{"phones", "The labels"}, input{"timeline", "When the video's frames are shown"},
     input{"apart_s", "How far the sound has each, from speech.fit_phones; without it only times are compared"},
     param("tolerance_s", &CheckLabelsOptions::tolerance_s, range{0.0, 10.0}, unit{"s"},
           "How much sooner or later than the pictures the labels may end", inert{"says only what is refused"}),
     param("window_s", &CheckLabelsOptions::window_s, range{0.1, 60.0}, unit{"s"}, "Of speech that is judged at a time",
           inert{"says only what is refused"}),
     param("match_score", &CheckLabelsOptions::match_score, range{-100.0, 0.0}, unit{"1"},
           "Mean score of such a stretch below which its labels are not what is heard",
           inert{"says only what is refused"}),
     param("most_apart_s", &CheckLabelsOptions::most_apart_s, range{0.0, 10.0}, unit{"s"},
           "Median distance of such a stretch above which its labels are of another time",
           inert{"says only what is refused"}),
     output("checked", "The labels as they are"));
