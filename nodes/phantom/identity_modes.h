// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/make_head.h"
#include "nodes/types/shape_set.h"

namespace face::phantom {

// Directions in which persons differ, for the embedded head: skull, forehead, cheeks, jaw, chin, nose, lips, eyes,
// brows, ears, neck and fullness, each at one standard deviation, the asymmetric ones last. Sizes are those of
// anthropometry (Farkas, Anthropometry of the Head and Face, 1994: tables of North American adults) where it measures
// the trait, divided among the modes that change it. Made for make_head with the same options, vertex by vertex.
//
// The lips still touch and cross nowhere (both move alike where they meet), eyeballs move as spheres with the lids
// around them, teeth, gums and tongue move as one with the lips' middle, lashes and brows follow the skin. Blend shapes
// are not part of a mode: a head of a person is the neutral plus its modes, with the rig's own shapes (make_person adds
// what shut lids need).
ShapeSet identity_modes(const MakeHeadOptions& options = {});

}  // namespace face::phantom
