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

struct ReanimateOptions {
  std::int64_t samples = 2;  // per pixel and axis
  std::int64_t moments = 4;  // mouths drawn between a frame and the next, for motion blur
};

// render_into for a video: the mouth of each frame is the mean of several moments up to the next frame (temporal
// supersampling by 4 in Blanz et al., Reanimating Faces in Images and Video, 2003, section 4.2). A frame whose fit did
// not converge stays as it is. teeth: of measure_teeth.h; null: as bright as the skin.
Image reanimate(const MorphableModel& model, const Rig& person, const AlbedoMap& albedo, const FaceFit& fit,
                const Image& frame, const Image& background, const engine::Window<Weights>& weights,
                const Matrix* teeth = nullptr, const ReanimateOptions& options = {});

}  // namespace face::texture
