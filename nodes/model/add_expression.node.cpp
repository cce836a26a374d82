// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/resample_shape.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.add_expression", &add_expression, version{1},
     doc{"One person's expression on another: the scan of A smiling minus A neutral plus B neutral."},
     input{"expression", "A with the expression"}, input{"neutral", "A without it"}, input{"other", "B"},
     output("shape", "B with the expression"));
