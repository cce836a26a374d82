// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::align {

struct ChooseReferenceOptions {
  std::string frame;      // id; empty = found
  double openness = 0.3;  // of the range between the most closed and the widest mouth
};

struct ChooseReferenceResult {
  DepthScan scan;
  Landmarks markers;
  Image interior;     // what was removed of its mouth
  std::string frame;  // its id
};

// The reference of a corpus: a frame with a slightly open mouth (Bargmann, Blanz and Seidel, section 3), named or
// found. How far a mouth is open is the removed area inside the lips (interiors, of mask.remove_mouth). Of the frames
// that see nearly all markers (nine tenths of what any frame sees; those of few frames see all, and their mouths may
// all be shut) the one is taken whose area is nearest to `openness` of the 95th percentile. scans, markers, interiors:
// of all frames, with the same ids.
ChooseReferenceResult choose_reference(const engine::Seq<DepthScan>& scans, const engine::Seq<Landmarks>& markers,
                                       const engine::Seq<Image>& interiors, const ChooseReferenceOptions& options = {});

}  // namespace face::align
