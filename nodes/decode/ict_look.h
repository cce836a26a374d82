// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/decode/obj.h"
#include "nodes/types/mesh.h"

namespace face::decode {

// Gives the ICT head a look without its textures (they are not part of the Light model): parts with colour and gloss
// from the materials of `obj`, polygons sorted by part, and vertex colours that tint lips and brows and paint iris and
// pupil. mesh: the ICT mesh in mm, polygons in the order of obj.
void dress_ict_mesh(const Obj& obj, Mesh& mesh);

}  // namespace face::decode
