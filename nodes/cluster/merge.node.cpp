// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/merge.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::cluster;

NODE("cluster.merge", &merge, version{1},
     doc{"Merges groups whose exemplars are alike until fewer would explain the points clearly worse."},
     input{"points", "N x D"}, input{"labels", "N x 1: number of every point's group"},
     input{"exemplars", "K x 1: the point that stands for every group"},
     input{"neutral", "D numbers: the shape at rest (default: the mean)"},
     param("groups", &MergeOptions::groups, range{0, 63}, unit{"1"}, "How many to keep; 0 finds the knee of the error"),
     param("max_distance", &MergeOptions::max_distance, range{0, 1e300}, unit{"1"},
           "Exemplars nearer than this are merged whatever the error", inert{"0 merges by the error alone"}),
     output("labels", &MergeResult::labels, "N x 1"), output("exemplars", &MergeResult::exemplars, "K x 1"),
     output("curve", &MergeResult::curve, "Error and cost of merging for every number of groups"),
     output("knee", &MergeResult::knee, "The number of groups that the error suggests"));
