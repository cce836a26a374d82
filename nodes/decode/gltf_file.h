// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"

namespace tinygltf {
class Model;
struct Mesh;
}  // namespace tinygltf

namespace face::decode {

// The glTF file of a folder that has one, or the file itself.
engine::File gltf_main_file(const engine::File& file);

// Reads it; what it refers to is looked for in what was given, and nowhere else. Pictures are left out. Throws with the
// file's name where it is none, or damaged.
tinygltf::Model load_gltf(const engine::File& given, const engine::File& main);

// The name of a morph target (extras.targetNames), or "target N (unnamed)".
std::string gltf_target_name(const tinygltf::Mesh& mesh, std::size_t index);

}  // namespace face::decode
