// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_images.h"

#include "engine/node.h"
#include "nodes/model/fit_image_params.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.fit_images", &fit_images, version{7},
     doc{"Analysis by synthesis of several pictures of one person, who is shared: pose, focal length, light, identity, "
         "albedo and expression."},
     input{"model", "The morphable model"}, input{"pictures", "One face"},
     input{"landmarks", "Named points on each, 7 to 20 or more"}, FIT_IMAGE_PARAMS,
     output("fits", "The fit of each picture"));
