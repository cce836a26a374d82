// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_rig.h"

#include "engine/node.h"
#include "nodes/types/rig.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.rig", &read_rig, version{3},
     doc{"Reads a head with blend shapes: an ICT-FaceKit folder, or a GLB or glTF file with morph targets."},
     input{"file", "An ICT-FaceKit folder, or a GLB or glTF file"},
     input{"names", "JSON object that maps the file's shape names to ARKit's, where they differ"},
     param("unit", &ReadRigOptions::unit,
           {{"automatic", LengthUnit::automatic}, {"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}},
           "Unit of the lengths in the file; automatic goes by the size of the head"),
     output("rig", "Neutral mesh in mm and its shapes, the ARKit-52 first"));
