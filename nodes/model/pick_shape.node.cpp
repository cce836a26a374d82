// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pick_shape.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.pick_shape", &pick_shape, version{1}, doc{"One shape of many, by its id."}, input{"shapes", "Shapes"},
     param("id", &PickShapeOptions::id, "Which one; empty = the first"), output("shape", "The shape"));
