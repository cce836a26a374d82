// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/truth_landmarks.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.truth_landmarks", &truth_landmarks, version{2},
     doc{"Where a head's named points are in a picture, exact, and whether the camera sees them."},
     input{"rig", "Head with landmarks68"}, input{"weights", "Blend-shape weights of the frame"},
     input{"world_from_head", "Where the head is; unconnected: at rest"}, input{"camera", "Where it is seen from"},
     param("width_px", &TruthLandmarksOptions::width_px, range{1, 4096}, unit{"px"}, "Width of the picture"),
     param("height_px", &TruthLandmarksOptions::height_px, range{1, 4096}, unit{"px"}, "Height of the picture"),
     param("set", &TruthLandmarksOptions::set,
           {{"multipie68", LandmarkSet::multipie68}, {"lips18", LandmarkSet::lips18}},
           "The 68 points of Multi-PIE, or 3 rigid, 12 outer lip and 3 jaw points"),
     output("landmarks", "The points"));
