// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/measure_leakage.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.measure_leakage", &measure_leakage, version{3},
     doc{"How much of one true movement, as a blink, the first coefficients of a linear space of shapes tell."},
     input{"coefficients", "Of every frame"}, input{"truth", "The true weights of every frame"},
     param("components", &MeasureLeakageOptions::components, range{1, 10000}, unit{"1"},
           "How many of the coefficients"),
     param("shape", &MeasureLeakageOptions::shape, "The movement, by ARKit's name"),
     output("table",
            "leakage_percent (R^2), by_chance_percent, likely_by_chance_percent, frames, "
            "elsewhere_percent (R^2 in frames that did not teach it)"));
