// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "nodes/types/image.h"

struct AVFrame;

namespace face::decode {

// A decoded picture as 8-bit sRGB: grey stays grey, all else becomes RGB, without transparency. `title` is what
// messages call it.
Image image_of(const AVFrame& frame, const std::string& title);

// A PNG, JPEG or WebP file in memory; what is none, or damaged, has no pixels.
Image read_picture_bytes(std::string_view bytes, const std::string& title);

}  // namespace face::decode
