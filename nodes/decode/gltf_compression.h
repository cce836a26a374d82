// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace face::decode {

// Whether the bytes of a glTF file name one of the extensions below.
bool mentions_compression(std::string_view bytes);

// Where a buffer view is packed by EXT_meshopt_compression; null where it is not.
nlohmann::json* meshopt_of(nlohmann::json& view);

// Turns a glTF document, all of whose bytes lie in `binary` as its first buffer, into one without
// EXT_meshopt_compression and KHR_draco_mesh_compression: what they hold is put behind the binary chunk, by
// meshoptimizer and Draco. Throws, naming the file and the place, where it is damaged.
void undo_compression(nlohmann::json& document, std::string& binary, const std::string& title);

}  // namespace face::decode
