// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/texture/draw_face.h"
#include "nodes/types/image.h"

namespace face::texture {

// The layer over the picture, which moves with it (follow_face.h); where a face was by the mask (grey) and is no more,
// the background. Along the edge of the mouth the drawing is made as unsharp as the picture (picture_blur.h). scale:
// pixels per mm of the face.
Image lay_over(const FaceLayer& layer, const Image& picture, const Image& background, const Image& mask, double scale);

}  // namespace face::texture
