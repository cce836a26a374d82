// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"

namespace face::exports {

// Writes an image as PNG, without loss. The same image always gives the same bytes.
engine::File export_png(const Image& image);

}  // namespace face::exports
