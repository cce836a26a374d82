// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/mouth_shapes.h"

#include "engine/node.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.mouth_shapes", &mouth_shapes, version{1}, doc{"Five mouths to try a fitted face with."},
     input{"rig", "The rig whose shapes they mix"}, output("weights", "closed, open, round, wide, smile"));
