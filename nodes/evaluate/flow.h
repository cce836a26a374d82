// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct FlowResult {
  Table table;   // row "all", over the pixels of all frames
  Table frames;  // the same per frame
};

// Endpoint error |d - d*| of flow over the pixels that are valid in both (Baker et al., A Database and Evaluation
// Methodology for Optical Flow, IJCV 92, 2011, eq. 5):
//   epe_mean_px, epe_p95_px   p95 of all frames from a histogram with steps of 0.01 px, exact per frame
//   over_1px_percent          share with an error above 1 px
//   valid_percent             of the truth's valid pixels, those that the flow calls valid
FlowResult flow(const engine::Seq<FlowField>& flow, const engine::Seq<FlowField>& truth);

}  // namespace face::evaluate
