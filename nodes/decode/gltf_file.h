// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

#include "engine/port.h"

namespace tinygltf {
class Model;
struct Mesh;
struct Primitive;
}  // namespace tinygltf

namespace face::decode {

// The glTF file of a folder that has one, or the file itself; none where a folder has none or several.
std::optional<engine::File> find_gltf(const engine::File& file);

// The same; throws where there is none.
engine::File gltf_main_file(const engine::File& file);

// Reads it; what it refers to is looked for in what was given, and nowhere else. Pictures are as encoded as in the
// file; meshes that Draco or meshopt packed are unpacked. Throws with the file's name where it is none, or damaged.
tinygltf::Model load_gltf(const engine::File& given, const engine::File& main);

// The name of a morph target: where exporters write it, that is extras.targetNames of the mesh, or of the primitive
// (UniVRM, FBX2glTF), or the name of the accessor of its offsets; else "target N (unnamed)".
std::string gltf_target_name(const tinygltf::Model& model, const tinygltf::Mesh& mesh,
                             const tinygltf::Primitive& primitive, std::size_t index);

}  // namespace face::decode
