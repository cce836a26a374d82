// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/decode/rig_shapes.h"
#include "nodes/types/rig.h"

namespace tinygltf {
class Model;
}

namespace face::decode {

// Reads a GLB or glTF 2.0 file: all meshes of its scene, merged, with their morph targets (named by
// extras.targetNames). A folder with one such file may hold the buffers that it refers to. Vertices that differ in
// texture coordinates or normals only are merged, so that the surface is closed again. Materials give colour and gloss,
// textures (PNG, JPEG, WebP) the colours of vertices. What our exporter notes in extras.facegraph (marks, the vertices
// of the rig it wrote) comes back; for other files mouth_marks.h finds the marks.
Rig read_gltf_rig(const engine::File& file, const ShapeNames& names, LengthUnit unit);

// The same of a file that load_gltf has read; `title` names it.
Rig rig_of_gltf(const tinygltf::Model& model, const std::string& title, const ShapeNames& names, LengthUnit unit);

}  // namespace face::decode
