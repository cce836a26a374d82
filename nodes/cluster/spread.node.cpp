// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/spread.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::cluster;

NODE("cluster.spread", &spread, version{1},
     doc{"Takes the points at the ends of the leading principal components, for comparison."}, input{"points", "N x D"},
     param("axes", &SpreadOptions::axes, range{1, 1000}, unit{"1"}, "Components, each with two ends"),
     output("labels", &SpreadResult::labels, "N x 1: nearest of these points"),
     output("exemplars", &SpreadResult::exemplars, "K x 1: the points"));
