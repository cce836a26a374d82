// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"

namespace face::track {

struct LipThicknessOptions {
  double open_share = 0.2;   // of a line across the mouth: one that is open by more tells how thick the lips are
  double thin_share = 0.3;   // of these lines: the quantile of the thickness that counts
  double least_share = 0.8;  // of the thickness at rest: no lip is taken for thinner
};

// The shut mouth of `rest` with lips that are no thicker than those of open mouths. Somebody whose lips are not quite
// together at rest shows a little of teeth and hollow between them, which the first look (inner_lips.h) takes for lips:
// their thickness would then hide as much of every opening. Lips of open mouths are told better, but tongue and gums
// are taken for them, too: a low quantile, over all frames and the three lines, of how thick they are as a share of
// rest, for the upper and the lower lip each; above 1 nothing changes. landmarks: of every frame of a head that stands
// still (stabilise.h), with where the lips part by the first look; lines with a point that is not valid do not count.
// rest: the same points of the shut mouth (find_rest.h). Where no mouth is open, or rest does not say how thick the
// lips are, the result is rest.
Landmarks lip_thickness(const engine::Seq<Landmarks>& landmarks, const Landmarks& rest,
                        const LipThicknessOptions& options = {});

}  // namespace face::track
