// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/export/export_points.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.usda", &export_usda, version{1},
     doc{"Writes a mesh and the vertices of every frame as USD in text, with time samples."}, input{"mesh", "The mesh"},
     input{"points", "The vertices of every frame"}, input{"timeline", "When every frame is shown"},
     output("file", "The .usda file"));
