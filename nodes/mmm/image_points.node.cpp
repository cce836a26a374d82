// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/image_points.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.image_points", &image_points, version{1},
     doc{"Pictures as points among their principal components, to be clustered."}, input{"images", "Of one size"},
     param("components", &ImagePointsOptions::components, range{1, 1000}, unit{"1"}, "Principal components at most",
           inert{"few pictures have fewer"}),
     param("thumbnail_px", &ImagePointsOptions::thumbnail_px, range{4, 256}, unit{"px"},
           "Width of the small pictures that are compared"),
     param("whiten", &ImagePointsOptions::whiten, "Each component counts the same (Mahalanobis's distance)"),
     output("points", "One row per picture"));
