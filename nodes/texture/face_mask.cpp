// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/face_mask.h"

#include "nodes/model/pose_model.h"
#include "nodes/texture/posed_face.h"

namespace face::texture {

Image face_mask(const MorphableModel& model, const FaceFit& fit) {
  const PosedFace face = pose_face(model.mean, model::pose_model(model, fit.identity, fit.expression), fit, 1);
  Image mask;
  mask.width = fit.image_width_px;
  mask.height = fit.image_height_px;
  mask.channels = 1;
  mask.pixels.assign(face.raster.triangles.size(), 0);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    if (face.raster.triangles[i] >= 0) mask.pixels[i] = 255;
  return mask;
}

}  // namespace face::texture
