// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "nodes/types/image.h"

namespace face::mmm {

// Throws unless the picture has pixels, three channels and as many bytes as that takes; `name` is told.
void check_picture(const Image& image, const std::string& name);

// The same, and of the size of `model`.
void check_size(const Image& image, const std::string& name, const Image& model, const std::string& model_name);

}  // namespace face::mmm
