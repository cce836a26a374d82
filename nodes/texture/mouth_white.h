// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

#include "nodes/model/skin_atlas.h"
#include "nodes/texture/posed_face.h"
#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/rig.h"

namespace face::texture {

// What something white in the mouth looks like in the picture, in full light.
struct MouthWhite {
  std::array<double, 3> colour{};  // sRGB
  double parallel = 0;             // brightness of the parallel light over all light that reaches the skin there
};

// As the skin about the mouth shows itself, a little brighter and half its colour. Not by way of the light: a fit
// cannot tell a lighter skin from a stronger light, and teeth have no colour of their own in the picture to go by.
// Without landmarks all skin counts.
MouthWhite mouth_white(const Rig& person, const AlbedoMap& map, const model::SkinAtlas& atlas, const PosedFace& face,
                       const FaceLight& light);

}  // namespace face::texture
