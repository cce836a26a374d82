// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::exports {

struct ExportLiveLinkCsvOptions {
  int timecode_rate_hz = 60;  // frames per second of the timecode; it changes no time, only how times are spelt
};

// Writes weights as Live Link Face records them: Timecode (HH:MM:SS:FF.mmm, mmm thousandths of a frame),
// BlendShapeCount (61), the 52 ARKit weights in the order of arkit.h, and 9 angles of head and eyes, which are 0.
// Weights beyond the 52 are left out, absent ones are 0.
engine::File export_live_link_csv(const engine::Seq<Weights>& frames, const Timeline& timeline,
                                  const ExportLiveLinkCsvOptions& options = {});

}  // namespace face::exports
