// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/smooth_track.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.smooth_track", &smooth_track, version{1},
     doc{"Takes the trembling out of a tracked head, by as much as it trembles."},
     input{"model", "The morphable model"}, input{"fits", "The fit of each frame, of model.track_video"},
     output("smoothed", "The same with other cameras"));
