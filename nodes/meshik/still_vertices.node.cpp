// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/still_vertices.h"

#include "engine/node.h"
#include "nodes/types/mesh.h"
#include "nodes/types/vertex_targets.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.still_vertices", &still_vertices, version{1},
     doc{"Vertices that no example moves, held at rest: what keeps a driven face on its skull."},
     input{"reference", "The mesh at rest"}, input{"examples", "The same mesh in other poses"},
     param("count", &StillVerticesOptions::count, range{1, 1000}, unit{"1"}, "Vertices at most"),
     param("still_mm", &StillVerticesOptions::still_mm, range{0.0, 10.0}, unit{"mm"},
           "A vertex that no example moves farther stands still"),
     output("targets", "Their places at rest, for mmm.scale_motion"));
