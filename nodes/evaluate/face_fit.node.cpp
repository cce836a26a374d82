// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/face_fit.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.face_fit", &face_fit, version{1},
     doc{"A fit of a picture beside the person whom it shows: vertices, orientation of the head, lip gap."},
     input{"model", "The morphable model"}, input{"fit", "The fit"},
     input{"rig", "The person, of the model's vertices"}, input{"weights", "The person's true expression"},
     input{"world_from_head", "Where the head truly is; unconnected: at rest"}, input{"camera", "The true camera"},
     input{"start", "The fit of the first frame, from which turns are counted; unconnected: from the camera"},
     input{"start_world_from_head", "Where the head truly was there"},
     output("table", "One row: vertex_mm, shape_mm, size_percent, pose_deg, lip_gap_mm, and what the fit says itself"));
