// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/face_flow.h"

#include "engine/node.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.face_flow", &face_flow, version{1},
     doc{"Robust optical flow of a face from the previous frame, or from one frame to all, for track.chain_flow."},
     input{"frames", "The video's frames", window{1, 0}}, input{"start", "Points whose box is looked at"},
     input{"reference", "The picture that the flow starts from; without it the previous frame"},
     param("half_size", &FaceFlowOptions::half_size, "Of pictures of half the width and height"),
     param("margin", &FaceFlowOptions::margin, range{0.0, 10.0}, unit{"1"},
           "About the box of the points, as a share of its larger side"),
     param("levels", &FaceFlowOptions::levels, range{1, 10}, unit{"1"}, "Pyramid levels"),
     param("coarse_warps", &FaceFlowOptions::coarse_warps, range{1, 50}, unit{"1"},
           "Linearisations on every level but the finest"),
     param("fine_warps", &FaceFlowOptions::fine_warps, range{1, 50}, unit{"1"}, "Linearisations on the finest level"),
     output("flow", "Displacement of the pixels of the face"));
