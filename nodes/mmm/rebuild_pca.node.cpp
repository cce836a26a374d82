// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/rebuild_pca.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.rebuild_pca", &rebuild_pca, version{1},
     doc{"Pictures as principal components of examples have them, for comparison with a morphable model."},
     input{"examples", "What the components are found from"}, input{"pictures", "What is rebuilt"},
     param("components", &RebuildPcaOptions::components, range{1, 10000}, unit{"1"}, "Components at most",
           inert{"few examples have fewer"}),
     output("rebuilt", "The pictures, rebuilt"));
