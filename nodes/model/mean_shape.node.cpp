// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/mean_shape.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.mean_shape", &mean_shape, version{1}, doc{"The mean of many shapes."},
     input{"shapes", "Shapes of one mesh"}, output("shape", "Their mean"));
