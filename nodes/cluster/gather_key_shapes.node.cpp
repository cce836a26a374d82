// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/gather_key_shapes.h"

#include "engine/node.h"
#include "nodes/types/key_shapes.h"
using namespace engine::declare;
using namespace face::cluster;

NODE("cluster.key_shapes", &gather_key_shapes, version{1},
     doc{"Gathers the frames that groups of landmarks are represented by."},
     input{"tracks", "Landmarks of every frame"}, input{"frames", "Rows of the matrix, from cluster.landmark_points"},
     input{"labels", "Group of every row"}, input{"exemplars", "Row that stands for every group"},
     output("key_shapes", "The shapes, largest group first"));
