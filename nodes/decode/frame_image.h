// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "nodes/types/image.h"

struct AVFrame;

namespace face::decode {

// A decoded picture as 8-bit sRGB: grey stays grey, all else becomes RGB, or RGBA where it has transparency and that is
// asked for. `title` is what messages call it.
Image image_of(const AVFrame& frame, const std::string& title, bool with_alpha = false);

// A PNG, JPEG or WebP file in memory, with its transparency; what is none, or damaged, has no pixels.
Image read_picture_bytes(std::string_view bytes, const std::string& title);

}  // namespace face::decode
