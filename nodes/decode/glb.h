// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/port.h"

namespace face::decode {

// The JSON of a glTF file and the bytes of its buffers, which become one: buffers in the text and buffers and pictures
// in files beside it (a folder was given) are taken in. A buffer that is nowhere is left out where only compressed
// views name it (EXT_meshopt_compression). False for what is no glTF file, has no mesh, or where a buffer is missing.
// Throws, naming the file, where it is damaged.
bool read_glb(const engine::File& given, nlohmann::json& document, std::string& binary);

// Fills bytes up to a multiple of 4, as glTF wants its chunks and views.
void pad(std::string& bytes, char filler = '\0');

// A .glb of a JSON document and its binary chunk, which is the document's first buffer: that is set here.
std::string glb_bytes(nlohmann::json document, std::string binary);

}  // namespace face::decode
