// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "nodes/types/image.h"

namespace face::render {

// The bytes of a PNG file. The same image always gives the same bytes.
std::string encode_png(const Image& image);

}  // namespace face::render
