// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::mmm {

struct SettleMouthOptions {
  // Points that the jaw does not move.
  std::vector<std::string> rigid = {"30", "31", "33", "35", "36", "39", "42", "45"};
  double flow_error_px = 1;  // that a followed point of the lips has where the picture tells its place
  double lips_part_px = 1;   // error of where the lips are found to part
};

// Points of a mouth that were followed by flow (track.chain_flow), put where the lips are. Flow knows how the edge of a
// lip moves across, hardly how it moves along; on even skin it follows the light in place of the skin; and between open
// lips it invents what was not to be seen before. So, of the 68 points of Multi-PIE:
// - a followed point of outer lips (48 to 59) and chin (05 to 11) counts as surely, in each direction, as the picture
//   around it tells its place (track::add_information);
// - where the edge of the lower lip is not to be seen where flow has it, but is farther up or down, flow is forgotten;
// - edge of the lips and chin are looked for as they look on the reference (track::see_outline, see_jaw_line);
// - points of inner lips (60 to 67) are where the lips part (track::inner_lips), compared with what is found on the
//   reference; flow says nothing of them;
// - and all are settled at once (track::settle): a mouth moves in the ways of track::mouth_modes from where the head
//   alone would put it, its inner edge with the outer one or apart from it.
//
// reference: the first frame. start: the points there (chain_flow's home). image, landmarks: a later frame. depths_px:
// as many as start has points, how far they are towards the viewer, px (meshik.landmark_depths), so that the head is a
// solid that turns and nods; null = it is flat. Points of other names stay as they are, and so does everything where
// one of the twelve outer points of the lips is missing or not valid on either frame.
Landmarks settle_mouth(const Image& reference, const Landmarks& start, const Image& image, const Landmarks& landmarks,
                       const Matrix* depths_px, const SettleMouthOptions& options = {});

}  // namespace face::mmm
