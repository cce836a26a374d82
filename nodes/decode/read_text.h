// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"

namespace face::decode {

// Reads a text as UTF-8, without white space at either end. A byte order mark is dropped; UTF-16 with one is converted.
// Throws where nothing is left, and where bytes are not UTF-8, with line and byte.
std::string read_text(const engine::File& file);

}  // namespace face::decode
