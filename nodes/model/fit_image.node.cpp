// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_image.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.fit_image", &fit_image, version{1},
     doc{"Analysis by synthesis of one picture: pose, focal length, light, identity, albedo and expression."},
     input{"model", "The morphable model"}, input{"picture", "A face"},
     input{"landmarks", "Named points on it, 7 to 20 or more"},
     param("identities", &FitImageOptions::identities, range{0, 1000}, unit{"1"}, "Identity components used"),
     param("albedos", &FitImageOptions::albedos, range{0, 1000}, unit{"1"}, "Albedo components used"),
     param("expressions", &FitImageOptions::expressions, range{0, 1000}, unit{"1"}, "Expression components used"),
     param("points", &FitImageOptions::points, range{50, 100000}, unit{"1"}, "Random pixels per step"),
     param("steps", &FitImageOptions::steps, range{1, 1000}, unit{"1"}, "Steps at each of three sizes"),
     param("image_weight", &FitImageOptions::image_weight, range{0, 1000000}, unit{"1"},
           "How many independent points the picture counts as"),
     param("point_sigma", &FitImageOptions::point_sigma, range{0.001, 0.5}, unit{"1"},
           "Error of a placed point over the distance of the outer corners of the eyes"),
     param("mouth_sigma_mm", &FitImageOptions::mouth_sigma_mm, range{0.01, 1000}, unit{"mm"},
           "Spread of the lip gap about 0: an open mouth must be seen"),
     param("max_image_rms", &FitImageOptions::max_image_rms, range{0.001, 1}, unit{"1"},
           "Difference of picture and model above which the fit is not believed"),
     param("seed", &FitImageOptions::seed, range{0, 1000000000}, unit{"1"}, "Of the random pixels"),
     output("fit", "The fit"));
