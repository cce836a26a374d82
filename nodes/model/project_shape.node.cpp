// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/region_pca.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.project_shape", &project_shape, version{1}, doc{"Coefficients of a shape in a linear space of shapes."},
     input{"model", "The space"}, input{"shape", "The shape"},
     input{"known", "False where the frame is lost: no coefficients; unconnected: it is not"},
     param("in_sigmas", &ProjectShapeOptions::in_sigmas, "Coefficients count in standard deviations"),
     output("coefficients", "One per component"));
