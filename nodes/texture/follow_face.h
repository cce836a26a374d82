// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/texture/draw_face.h"
#include "nodes/types/image.h"

namespace face::texture {

// The picture drawn along with a face that is drawn anew: what is beside the layer's lower outline, the rest of the
// chin, neck and collar, moves as the outline does, less the farther away. So where a person's own jaw is wider than
// the model's no second chin is left where the old one was. mask: where the face was by the fit; farther than some
// millimetres outside of it the picture stays as it is. scale: pixels per mm.
Image follow_face(const FaceLayer& layer, const Image& picture, const Image& mask, double scale);

}  // namespace face::texture
