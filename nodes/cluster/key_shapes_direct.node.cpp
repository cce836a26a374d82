// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/key_shapes_direct.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::cluster;

NODE("cluster.key_shapes_direct", &key_shapes_direct, version{1},
     doc{"Finds shapes and weights >= 0 that explain all points with least squared error, for comparison."},
     input{"points", "N x D"}, input{"neutral", "D numbers: the shape at rest (default: the mean)"},
     param("groups", &KeyShapesDirectOptions::groups, range{1, 63}, unit{"1"}, "How many shapes"),
     param("rounds", &KeyShapesDirectOptions::rounds, range{1, 10000}, unit{"1"},
           "How often weights and shapes are found in turn"),
     param("seed", &KeyShapesDirectOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed begins at other points"),
     output("labels", &KeyShapesDirectResult::labels, "N x 1: the shape with the most to say"),
     output("exemplars", &KeyShapesDirectResult::exemplars, "K x 1: the point nearest to every shape"),
     output("shapes", &KeyShapesDirectResult::shapes, "K x D"),
     output("error", &KeyShapesDirectResult::error, "Root mean square of what is not explained"));
