// SPDX-License-Identifier: Apache-2.0
// The parameters of model.fit_image and model.fit_images, for their declarations, which include engine/node.h first.
#pragma once
#include "nodes/model/fit_image.h"

// A macro, as a declaration takes its parameters one by one.
#define FIT_IMAGE_PARAMS                                                                                            \
  param("identities", &FitImageOptions::identities, range{0, 1000}, unit{"1"}, "Identity components used"),         \
      param("albedos", &FitImageOptions::albedos, range{0, 1000}, unit{"1"}, "Albedo components used"),             \
      param("expressions", &FitImageOptions::expressions, range{0, 1000}, unit{"1"}, "Expression components used"), \
      param("points", &FitImageOptions::points, range{50, 100000}, unit{"1"},                                       \
            "Random pixels per step and picture, four times as many at the last size"),                             \
      param("steps", &FitImageOptions::steps, range{1, 1000}, unit{"1"},                                            \
            "Steps at each of four sizes, half as many more at the last"),                                          \
      param("image_weight", &FitImageOptions::image_weight, range{0, 1000000}, unit{"1"},                           \
            "How many independent points the picture counts as"),                                                   \
      param("point_sigma", &FitImageOptions::point_sigma, range{0.001, 0.5}, unit{"1"},                             \
            "Error of a placed point over the distance of the outer corners of the eyes"),                          \
      param("mouth_sigma_mm", &FitImageOptions::mouth_sigma_mm, range{0.01, 1000}, unit{"mm"},                      \
            "Spread of the lip gap about 0: an open mouth must be seen"),                                           \
      param("max_image_rms", &FitImageOptions::max_image_rms, range{0.001, 1}, unit{"1"},                           \
            "Difference of picture and model above which the fit is not believed"),                                 \
      param("seed", &FitImageOptions::seed, range{0, 1000000000}, unit{"1"}, "Of the random pixels")
