// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_png.h"

#include "nodes/render/encode_png.h"

namespace face::exports {

engine::File export_png(const Image& image) { return engine::File::from_bytes(render::encode_png(image), ".png"); }

}  // namespace face::exports
