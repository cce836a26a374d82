// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_gltf.h"

#include "engine/node.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.gltf", &export_gltf, version{3},
     doc{"Writes a rig and its animation as binary glTF: a morph target per blend shape, in the rig's order, with "
         "names."},
     input{"rig", "Head and its blend shapes"}, input{"frames", "Blend-shape weights of every frame"},
     input{"timeline", "When every frame is shown"},
     input{"original", "The file that the rig was read from: glTF keeps its textures, bones and all else"},
     input{"names", "JSON object that maps its shapes' names to ARKit's, as decode.rig was given it"},
     param("morph_normals", &ExportGltfOptions::morph_normals,
           "Shapes move the normals too: a larger file, right shading"),
     output("file", "The .glb file"));
