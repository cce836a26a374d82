// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mmm.h"

namespace face::mmm {

// The multidimensional morphable model of a speaker's mouth (Ezzat et al. 2002, section 4; Speech-Driven 3D Facial
// Animation, section 3.1, N = 46): the pictures that a clustering has found typical, and the flows to them from one of
// them. images: normalised, of one size. exemplars: K x 1, numbers of images, of cluster.k_means or cluster.k_medoids;
// one that comes twice counts once.
// Differs from the papers: the reference is the prototype that is least unlike all others, not an arbitrary one; flows
// go from it to each prototype at once instead of along chains of similar pictures; flows are kept as 1/64 px. Warns
// where the pictures hardly differ: there is no mouth in them, or it does not move.
Mmm build(const engine::Seq<Image>& images, const Matrix& exemplars, engine::Progress& progress);

}  // namespace face::mmm
