// SPDX-License-Identifier: Apache-2.0
// What our exporter notes in a file's extras.facegraph, so that a rig comes back as it was.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/rig.h"

namespace tinygltf {
class Value;
}

namespace face::decode {

// The vertices that a note lists, or none. Refuses one that is not below limit.
std::vector<std::uint32_t> note_indices(const tinygltf::Value& notes, const char* key, std::size_t limit,
                                        const std::string& title);

// Marks of the mouth and of the face, names and gloss of parts, and the shapes that are known to be missing.
void read_notes(const tinygltf::Value& notes, const std::string& title, Rig& rig);

}  // namespace face::decode
