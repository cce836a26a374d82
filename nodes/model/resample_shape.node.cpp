// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/resample_shape.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.resample_shape", &resample_shape, version{1},
     doc{"A scanned person's shape and colours in another topology: identities in that of the expressions."},
     input{"shape", "Skin vertices of the person"}, input{"texture", "Their colours, one row"},
     input{"surface", "The surface that they belong to"}, input{"mean", "A shape of that surface"},
     input{"anchors", "Where the other topology's vertices lie on it in that shape"},
     output("shape", &ResampleShapeResult::shape, "Vertices of the other topology"),
     output("texture", &ResampleShapeResult::texture, "Their colours, one row"));
