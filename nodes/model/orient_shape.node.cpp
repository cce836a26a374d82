// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/match_cylinder.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.orient_shape", &orient_shape, version{1},
     doc{"Brings a scanned shape to rest: absolute orientation on the upper face, which the jaw leaves alone."},
     input{"shape", "Vertices of the surface's skin"}, input{"surface", "The reference surface"},
     param("scale_mm", &OrientShapeOptions::scale_mm, range{0.001, 1000.0}, unit{"mm"},
           "Distance at which a vertex counts a quarter"),
     output("shape", &OrientShapeResult::shape, "The shape in the surface's place"),
     output("surface_from_scan", &OrientShapeResult::surface_from_scan, "The motion"),
     output("rms_mm", &OrientShapeResult::rms_mm, "Distance of the upper face, weighted"));
