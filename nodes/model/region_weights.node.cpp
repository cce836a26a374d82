// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/sample_scan.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.region_weights", &region_weights, version{1},
     doc{"Weights for model.region_pca: an ellipse of the reference's picture, about the mouth."},
     input{"mesh", "From model.scan_mesh"},
     param("centre_x", &RegionWeightsOptions::centre_x, range{0.0, 1.0}, unit{"1"}, "Share of the picture's width"),
     param("centre_y", &RegionWeightsOptions::centre_y, range{0.0, 1.0}, unit{"1"}, "Share of the picture's height"),
     param("width", &RegionWeightsOptions::width, range{0.001, 2.0}, unit{"1"}, "Share of the picture's width"),
     param("height", &RegionWeightsOptions::height, range{0.001, 2.0}, unit{"1"}, "Share of the picture's height"),
     param("feather", &RegionWeightsOptions::feather, range{0.0, 1.0}, unit{"1"}, "Share over which it fades out"),
     output("weights", "One per vertex, 0 to 1"));
