// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/normalise.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.normalise", &normalise, version{2},
     doc{"How a head has moved since a reference frame, as a planar perspective, from robust flow of the pixels that "
         "move with the skull."},
     input{"reference", "The frame that stays where it is"}, input{"frame", "Another one"},
     input{"mask", "White where the head moves as a whole; without it all counts"},
     param("half_size", &NormaliseOptions::half_size, "Flow of pictures of half the size"),
     param("refine", &NormaliseOptions::refine, "The plane is made right by the pictures themselves, at full size"),
     param("outlier_px", &NormaliseOptions::outlier_px, range{0.01, 100.0}, unit{"px"},
           "Distance from the plane's motion whose weight is a quarter"),
     param("levels", &NormaliseOptions::levels, range{1, 10}, unit{"1"}, "Pyramid levels of the flow"),
     param("coarse_warps", &NormaliseOptions::coarse_warps, range{1, 50}, unit{"1"},
           "Linearisations on every level but the finest"),
     param("fine_warps", &NormaliseOptions::fine_warps, range{1, 50}, unit{"1"}, "Linearisations on the finest level"),
     output("target_from_reference", &FitPerspectiveResult::target_from_reference, "3 x 3, for whole pixels"),
     output("rms_px", &FitPerspectiveResult::rms_px, "Of the pixels that move as the plane does"),
     output("used", &FitPerspectiveResult::used, "How many these are"),
     output("solved", &FitPerspectiveResult::solved, "False where the pictures do not determine a perspective"));
