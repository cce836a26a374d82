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
  double odd = 1.2;       // frames this much more unlike the stream than the median one are passed over; 0 = none
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
// all be shut) the one is taken whose area is nearest to `openness` of the 95th percentile, and that looks, above its
// mouth, like most of the stream (upper_difference.h): a frame in a blink, or whose eyes look aside, is passed over for
// the next. In takes of the phantom open eyes are 0.7 to 1.1 times as unlike as the median frame, lids that are a third
// down 1.3 times, shut ones 1.9, eyes that look aside 1.4. scans, markers, interiors: of all frames, with the same ids,
// pictures of one size.
ChooseReferenceResult choose_reference(const engine::Seq<DepthScan>& scans, const engine::Seq<Landmarks>& markers,
                                       const engine::Seq<Image>& interiors, const ChooseReferenceOptions& options = {});

}  // namespace face::align
