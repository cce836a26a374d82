// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/types/rig.h"

namespace face::decode {

struct ReadRigOptions {
  LengthUnit unit = LengthUnit::automatic;  // of the lengths in the file
};

// Reads a head with blend shapes: an ICT-FaceKit folder (generic_neutral_mesh.obj, or neutral.obj, and an OBJ per
// shape), or a GLB or glTF file with morph targets. Triangles of which a transparent texture shows less than half
// (lashes, strands of hair) are parts that are not visible. Shapes are told by ARKit's names, whatever the case, with
// _L/_R or Left/Right; halves of a shape that ARKit has whole (browInnerUp, cheekPuff) are added up. `names`: a JSON
// object of the file's name -> ARKit's name, for a GLB that has others; may be null. A needed shape that is absent
// (needed_shapes in rig_shapes.h) is an error; others are empty and listed in Rig::missing.
Rig read_rig(const engine::File& file, const engine::File* names, const ReadRigOptions& options = {});

}  // namespace face::decode
