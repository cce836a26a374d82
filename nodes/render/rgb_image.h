// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"

namespace face::render {

// The image with 3 channels: grey is repeated, transparency dropped. Throws where pixels and size do not agree.
Image rgb_image(const Image& image);

}  // namespace face::render
