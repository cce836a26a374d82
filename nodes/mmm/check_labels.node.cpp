// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/check_labels.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.check_labels", &check_labels, version{1},
     doc{"Refuses labels that are not those of a video, and names the first that does not fit."},
     input{"phones", "The labels"}, input{"timeline", "When the video's frames are shown"},
     param("tolerance_s", &CheckLabelsOptions::tolerance_s, range{0.0, 10.0}, unit{"s"},
           "How much sooner or later than the pictures the labels may end", inert{"says only what is refused"}),
     output("checked", "The labels as they are"));
