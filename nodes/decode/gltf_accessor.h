// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace face::decode {

// The numbers of an accessor, dense or sparse (glTF 2.0, section 3.6.2), as rows x components. Integers that are marked
// normalised become -1 to 1 or 0 to 1. Throws, naming the file and the accessor, where it reaches beyond its buffer.
std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components, const std::string& title);

// The same for indices.
std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor, const std::string& title);

}  // namespace face::decode
