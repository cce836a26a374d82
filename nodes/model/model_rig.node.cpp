// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/region_pca.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.model_rig", &model_rig, version{1},
     doc{"A linear space of shapes as a rig, so that it can be rendered and exported as any head."},
     input{"model", "The space"}, input{"mesh", "Polygons and colours, from model.scan_mesh"},
     param("components", &ModelRigOptions::components, range{1, 10000}, unit{"1"}, "Largest number of shapes"),
     param("in_sigmas", &ModelRigOptions::in_sigmas, "Weights count in standard deviations"),
     output("rig", "Mean and modes"));
