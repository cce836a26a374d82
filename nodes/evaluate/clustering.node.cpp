// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/clustering.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.clustering", &clustering, version{1},
     doc{"How good groups around exemplars are: net similarity, and how many of the planted groups, small ones above "
         "all, "
         "were found."},
     input{"points", "N x D"}, input{"labels", "N x 1: group of every point"},
     input{"exemplars", "K x 1: the point that stands for every group"},
     input{"planted", "N x 1: the true groups; without them there is no recall"},
     input{"preference", "What an exemplar costs"},
     param("small", &ClusteringOptions::small, range{1, 1000000}, unit{"1"}, "Points of a small planted group at most"),
     output("table",
            "net_similarity, groups, small_groups, recall_percent, small_recall_percent, "
            "exemplar_recall_percent"));
