// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/pose_rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.pose_rig", &pose_rig, version{1}, cheap{},
     doc{"The vertices of a head at given weights, for the metrics that compare meshes."},
     input{"rig", "The head and its shapes"}, input{"weights", "How far each shape is on"},
     output("points", "Vertices in mm"));
