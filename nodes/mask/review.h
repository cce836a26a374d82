// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"
#include "nodes/types/table.h"

namespace face::mask {

struct ReviewOptions {
  std::int64_t pictures = 48;
  std::int64_t columns = 8;
  std::int64_t picture_px = 160;
  double doubt = 0.2;
};

struct ReviewResult {
  Table doubtful;         // a row per frame that may need another threshold: proposed_mm, instability, departure
  std::string overrides;  // the same as "overrides" of a graph's node
  Image sheet;            // the mouths of doubtful frames first, then of others at equal steps; red = removed
};

// Looks over the removal of a sequence: a frame is doubtful where its removed area changes by more than `doubt` of
// itself between the thresholds about its own (instability), or departs by more than that from the median over itself
// and four neighbours (departure), areas below 30 px counting as 30. What the paper leaves to the eye ("the parameter
// has to be readjusted for a small subset of frames").
// scans, interiors, reports: of every frame, from mask.remove_mouth.
ReviewResult review(const engine::Seq<DepthScan>& scans, const engine::Seq<Image>& interiors,
                    const engine::Seq<Table>& reports, const ReviewOptions& options = {});

}  // namespace face::mask
