// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pick_frames.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.pick_frames", &pick_frames, version{1}, doc{"The frames of a clip on which points were placed."},
     input{"frames", "The clip"}, input{"landmarks", "Points, by the frames' ids"}, output("picked", "These frames"));
