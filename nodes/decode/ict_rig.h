// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/decode/rig_shapes.h"
#include "nodes/types/rig.h"

namespace face::decode {

// Whether a folder holds an OBJ rig: a neutral mesh named like ICT-FaceKit's, in the folder or one below it.
bool is_obj_rig(const engine::File& folder);

// That mesh; throws where there is none.
const engine::File::Entry& obj_rig_neutral(const engine::File& folder);

// Reads a folder of OBJ files of equal vertex order: generic_neutral_mesh.obj (or neutral.obj) and one file per shape;
// identityNNN.obj (shapes of persons, not of expressions) are skipped. Shape files may hold `v` lines only. The ICT
// mesh gets its look and its landmarks; any other keeps plain parts and has its mouth marks found by geometry.
Rig read_obj_rig(const engine::File& folder, const ShapeNames& names, LengthUnit unit);

}  // namespace face::decode
