// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/k_medoids.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::cluster;

NODE("cluster.k_medoids", &k_medoids, version{1},
     doc{"Groups points about a given number of points among them, for comparison."}, input{"points", "N x D"},
     param("groups", &KMedoidsOptions::groups, range{1, 10000}, unit{"1"}, "How many groups"),
     param("restarts", &KMedoidsOptions::restarts, range{1, 1000}, unit{"1"}, "Runs of which the best counts"),
     param("seed", &KMedoidsOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed begins at other points"),
     output("labels", &KMedoidsResult::labels, "N x 1: number of every point's group"),
     output("exemplars", &KMedoidsResult::exemplars, "K x 1: the point that stands for every group"),
     output("error", &KMedoidsResult::error, "Sum of squared distances to the exemplars"));
