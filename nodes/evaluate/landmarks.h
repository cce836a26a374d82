// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct LandmarksOptions {
  std::string left_corner = "36";  // names of the outer corners of the eyes, 300-W's numbers as default
  std::string right_corner = "45";
  double failed_percent = 10;  // a frame with a larger NME is a failure; the AUC goes up to here
};

struct LandmarksResult {
  Table table;   // row "all"
  Table frames;  // per frame: nme_percent, rms_px, lost
};

// Compares tracked points with the true ones of the same names. Per frame NME = (1/N) sum |p_i - q_i| / d over the
// points that are valid in both, d the distance of the outer eye corners in the truth (Sagonas et al., 300 Faces
// In-The-Wild Challenge, Image and Vision Computing 47, 2016).
//   nme_percent     mean over frames; NaN where the truth has no eye corners
//   failure_percent share of frames whose NME is over failed_percent, or that have no valid point
//   auc_percent     area under the share of frames with NME <= e, for e from 0 to failed_percent, as a share of the
//   whole rms_px          root mean square distance of all valid points p95_px          95th percentile of the
//   distances lost_per_1000   points that the tracker lost while the truth has them, per 1000 points
//   lost_per_1000_frames  such points per 1000 frames
// A point of the truth that the track lacks by name counts as lost. Points of the track that the truth lacks are
// ignored.
LandmarksResult landmarks(const engine::Seq<Landmarks>& track, const engine::Seq<Landmarks>& truth,
                          const LandmarksOptions& options = {});

}  // namespace face::evaluate
