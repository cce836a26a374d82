// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"
#include "nodes/types/morphable_model.h"

namespace face::texture {

struct ExtractOptions {
  std::int64_t size_px = 1024;  // of the map's sides
};

// Reads a face's own colours off a picture: for every texel of the skin that the fit says is seen, the picture's value
// with the fit's light undone (Blanz et al., Reanimating Faces in Images and Video, 2003, section 3.1). Weights: the
// squared cosine of normal and line of sight, less at edges and in the dark. Texels that are not seen keep the model's
// estimate, times what seen texels around them differ from theirs, so that there is no edge.
AlbedoMap extract(const MorphableModel& model, const Image& picture, const FaceFit& fit,
                  const ExtractOptions& options = {});

}  // namespace face::texture
