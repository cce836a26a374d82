// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/image.h"
#include "nodes/types/phones.h"
#include "nodes/types/table.h"
#include "nodes/types/timeline.h"

namespace face::evaluate {

struct CurvePlotOptions {
  std::int64_t width_px = 1600;
  std::int64_t panel_px = 220;  // height of one panel
  double start_s = 0;
  double end_s = 0;  // 0 = the timeline's end
};

// Curves over time, with the phones and words underneath, for people who look. Every column of the tables is a curve;
// columns whose names end in the same unit ("_mm", "_px", "_ms", ...) share a panel, so that own and truth lie over
// each other; the first is drawn on top. The range of a panel holds its curves and 0; `more` has panels of its own
// below. A value that is no number leaves a gap. Phones that are too short for their label keep their bar. curves,
// more: a row per frame of the timeline; more and phones may be null.
Image curve_plot(const Table& curves, const Table* more, const Timeline& timeline, const Phones* phones,
                 const CurvePlotOptions& options = {});

}  // namespace face::evaluate
