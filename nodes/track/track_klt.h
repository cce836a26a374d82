// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::track {

struct TrackKltOptions {
  std::int64_t window_px = 15;     // side of the patch that is followed, odd
  std::int64_t levels = 3;         // of the pyramid, above the image itself
  double stiffness = 0.5;          // of the springs between neighbours; 0 follows every point alone
  double max_return_error_px = 1;  // a point followed there and back must come home this close
  double max_offset_px = 2;    // from where its neighbours say that it is, in the direction in which it is seen well
  double min_likeness = 0.8;   // correlation with a point's own patch that counts as seeing it again
  double max_anchor_px = 1.5;  // how far a point may be moved to its own patch
  std::vector<std::string> rigid = {"eye_inner_r", "eye_inner_l", "nose_tip"};  // points that always look alike
  double search_px = 5;  // how far from where it should be a lost point is looked for
};

struct TrackKltResult {
  Landmarks landmarks;         // in the order of the start points
  Landmarks layout;            // the start points with what corrections said: how the points lie to each other at rest
  Image patches;               // grey; the patch of every point where it was last placed by hand, side by side
  double lost = 0;             // points that are not valid in this frame
  double return_error_px = 0;  // largest there-and-back error of the points that were kept
};

// Follows points from the previous frame to this one by pyramidal KLT (Lucas and Kanade, An Iterative Image
// Registration Technique, IJCAI 1981; Bouguet, Pyramidal Implementation of the Lucas Kanade Feature Tracker, Intel
// 2000). frames: the previous frame and this one (window 1, 0). start: the points on the first frame. correction:
// points of this frame that somebody put right, by name; null where there are none. prior: this function's result for
// the previous frame.
//
// At the first frame the result is `start`. A correction replaces a point from its frame on. A point that does not come
// home when it is followed back (Kalal, Mikolajczyk, Matas: Forward-Backward Error, ICPR 2010), or that leaves its
// neighbours, is not valid and keeps its last good place; it is looked for again in every later frame, near where the
// other points say that it is, by the patch that it had where it was last placed by hand. Differs from plain KLT:
// points on contours are kept from sliding along them (settle.h), and against drift a point whose own patch is seen
// again near its place goes there. A rigid point is valid only while its own patch is seen: the corner of an eye would
// follow the closing lid otherwise.
TrackKltResult track_klt(const engine::Window<Image>& frames, const Landmarks& start, const Landmarks* correction,
                         const engine::Prior<TrackKltResult>& prior, const TrackKltOptions& options = {});

}  // namespace face::track
