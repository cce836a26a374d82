// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/region_pca.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.region_pca", &region_pca, version{1},
     doc{"Principal component analysis that looks at a region and yields whole faces. Without weights a plain one."},
     input{"shapes", "The examples"}, input{"weights", "Weight of every vertex, 0 or more: the region"},
     param("components", &RegionPcaOptions::components, range{1, 10000}, unit{"1"}, "Largest number of components"),
     param("least_sigma", &RegionPcaOptions::least_sigma, range{0.0, 1.0}, unit{"1"},
           "Components whose deviation is a smaller share of the first's are left out"),
     output("model", "Mean, modes and deviations"));
