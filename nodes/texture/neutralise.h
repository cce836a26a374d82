// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"

namespace face::texture {

struct NeutraliseOptions {
  double light_share = 0.75;
  double hair_contrast = 0.3;
};

// The person of a fit as a rig: all expression coefficients 0, the identity in the neutral, the rig's shapes as they
// are (the same displacement for everybody, as in the paper), the map's colours at the skin's vertices. Speaks with any
// weights. rig: of the model's vertices.
// A picture shows light times albedo, and a fit hardly tells a darker skin from a weaker light: of the difference
// between the person's brightness and the mean person's, light_share is taken to be the light's (0 = none, the map's
// colours as they are). Colours, not brightness, go towards the fitted components' the more, the less of them the
// picture tells: of a grey or very dark one the map's are what is read wrong, many times over. What hides the skin
// gives way to what is beside it or on the other side (uncover_skin.h), from hair_contrast of the logarithm on (0 =
// nothing does, and both sides stay as they are). Scalp, ears and neck (parts named "head") take the tone of the cheeks
// and go on from the face's edge.
Rig neutralise(const MorphableModel& model, const Rig& rig, const FaceFit& fit, const AlbedoMap& albedo,
               const NeutraliseOptions& options = {});

}  // namespace face::texture
