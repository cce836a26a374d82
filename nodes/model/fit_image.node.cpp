// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_image.h"

#include "engine/node.h"
#include "nodes/model/fit_image_params.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.fit_image", &fit_image, version{7},
     doc{"Analysis by synthesis of one picture: pose, focal length, light, identity, albedo and expression."},
     input{"model", "The morphable model"}, input{"picture", "A face"},
     input{"landmarks", "Named points on it, 7 to 20 or more"}, FIT_IMAGE_PARAMS, output("fit", "The fit"));
