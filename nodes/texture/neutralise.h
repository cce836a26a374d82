// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"

namespace face::texture {

// The person of a fit as a rig: all expression coefficients 0, the identity in the neutral, the rig's shapes as they
// are (the same displacement for everybody, as in the paper), the map's colours at the skin's vertices. Speaks with any
// weights. rig: of the model's vertices.
Rig neutralise(const MorphableModel& model, const Rig& rig, const FaceFit& fit, const AlbedoMap& albedo);

}  // namespace face::texture
