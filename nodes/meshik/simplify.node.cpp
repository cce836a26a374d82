// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/simplify.h"

#include "engine/node.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"
using namespace engine::declare;
using namespace face::meshik;

NODE(
    "meshik.simplify", &simplify, version{1},
    doc{"A head and example poses of it with fewer vertices: the same collapses for all poses, detail kept at lips and "
        "eyes."},
    input{"rig", "The head"}, input{"examples", "The same head in other poses"},
    param("vertices", &SimplifyOptions::vertices, range{4, 10000000}, unit{"1"}, "Vertices that are left"),
    param("detail", &SimplifyOptions::detail, range{0.0, 10000.0}, unit{"1"},
          "How much more a vertex counts at the landmarks of eyes and lips"),
    param("detail_mm", &SimplifyOptions::detail_mm, range{0.1, 1000.0}, unit{"mm"},
          "How far from them this reaches (standard deviation)"),
    output("simple_examples", "The poses with the vertices that are left"),
    output("rig", &SimplifyResult::rig, "The head with the vertices that are left"),
    output("binding", &SimplifyResult::binding, "Where the whole head's vertices lie on it, for meshik.carry_fine"),
    output("triangles", &SimplifyResult::triangles, "Triangles that are left"));
