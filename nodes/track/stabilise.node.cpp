// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/stabilise.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.stabilise", &stabilise, version{7},
     doc{"Takes the head's motion out of tracked points, by those that the jaw does not move."},
     input{"landmarks", "The points of each frame and its neighbours", window{33, 33}},
     input{"rest", "The points that the face is laid upon: those of the first frame"},
     input{"depths_px",
           "How far each of them is towards the viewer (meshik.landmark_depths): turns and nods come out as well"},
     input{
         "head",
         "Pose of the whole head since then and its likeness, 7 x 1 (track.klt); with depths it tells how the head is "
         "turned"},
     param("rigid", &StabiliseOptions::rigid, "Names of the points that the jaw does not move"),
     param("smooth_frames", &StabiliseOptions::smooth_frames, range{0.0, 3.0}, unit{"1"},
           "Standard deviation of the frames that the head's place is taken from; 0 = the frame alone"),
     output("stable", "The points as if the head stood still; rigid ones where rest has them"));
