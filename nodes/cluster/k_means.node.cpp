// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/k_means.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::cluster;

NODE("cluster.k_means", &k_means, version{1}, doc{"Groups points about a given number of centres, for comparison."},
     input{"points", "N x D"}, param("groups", &KMeansOptions::groups, range{1, 10000}, unit{"1"}, "How many groups"),
     param("max_iterations", &KMeansOptions::max_iterations, range{1, 100000}, unit{"1"}, "Rounds at most",
           inert{"most data settle before"}),
     param("seed", &KMeansOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed begins at other points"),
     output("labels", &KMeansResult::labels, "N x 1: number of every point's group"),
     output("exemplars", &KMeansResult::exemplars, "K x 1: the point nearest to every centre"),
     output("centres", &KMeansResult::centres, "K x D"),
     output("error", &KMeansResult::error, "Sum of squared distances to the centres"));
