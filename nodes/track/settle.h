// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "nodes/track/sighting.h"
#include "nodes/track/solid_head.h"
#include "nodes/types/landmarks.h"

namespace face::track {

// What keeps points together.
struct Bonds {
  double stiffness = 0.5;  // of the springs, 1/px^2; 0 leaves seen points where they were seen
  std::vector<std::vector<double>> modes =
      {};                               // shapes that the points take together, 2N offsets in px, one deviation each
  double slack_px = 2;                  // usual distance from such a shape of a point that takes part in it
  std::vector<std::size_t> rigid = {};  // points that carry the layout where two of them are seen; else all do
  std::vector<double> depths_px = {};   // of all points, towards the viewer: the layout is a solid; {} = it is flat
  std::optional<SolidHead> head = {};   // where the head is, of which the layout is a part; needs depths_px
  std::vector<Sighting> carried =
      {};  // of all points: where rigid ones that are not seen are taken to be; {} = nowhere
};

// Places all points at once: each near where it was seen, as surely as it was seen, and with the same offset from the
// layout as its neighbours. On a contour a point is seen well across and badly along; the neighbours then keep it from
// sliding. A point that was not seen goes where its neighbours say. (The energy of Birchfield and Pundlik, Joint
// Tracking of Features and Edges, CVPR 2008, eq. 5, solved in one step for all points; differs from it: springs act on
// offsets from the start layout, moved by a similarity, so that errors do not add up over frames, and they fall off
// with distance as a Gaussian of the points' median spacing; what the modes explain of the offsets costs only what the
// modes cost, as in a probabilistic shape model.) start: the layout, N points. sightings: N.
std::vector<Sighting> settle(const Landmarks& start, const std::vector<Sighting>& sightings, const Bonds& bonds);

}  // namespace face::track
