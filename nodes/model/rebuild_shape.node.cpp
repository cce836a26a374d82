// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/region_pca.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.rebuild_shape", &rebuild_shape, version{1}, doc{"The shape of coefficients in a linear space of shapes."},
     input{"model", "The space"}, input{"coefficients", "One per component, or fewer"},
     param("amplify", &RebuildShapeOptions::amplify, range{-100.0, 100.0}, unit{"1"},
           "How many times the departure from the mean is enlarged"),
     param("in_sigmas", &RebuildShapeOptions::in_sigmas, "Coefficients count in standard deviations"),
     output("shape", "The shape"));
