// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::texture {

struct RenderIntoOptions {
  std::int64_t samples = 2;  // per pixel and axis
};

// Puts a face back into its picture with other weights, under the light and before the camera that were found: from the
// cheeks to the chin it is drawn anew, with a soft edge; eyes, brows, hair and neck stay the picture's. Where the old
// face was and the new one is not, the background shows. weights: of the person's shapes; null: the fit's own
// expression, which gives the picture back. background null: the picture. teeth: of measure_teeth.h; null: as bright as
// the skin.
Image render_into(const MorphableModel& model, const Rig& person, const AlbedoMap& albedo, const FaceFit& fit,
                  const Image& picture, const Image* background, const Weights* weights, const Matrix* teeth = nullptr,
                  const RenderIntoOptions& options = {});

}  // namespace face::texture
