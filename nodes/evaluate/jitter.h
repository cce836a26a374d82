// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "engine/port.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/table.h"
#include "nodes/types/timeline.h"
#include "nodes/types/vertex_mask.h"

namespace face::evaluate {

struct JitterOptions {
  double cut_hz = 12;  // speech moves lips slower than this
};

// Share of a curve's power above cut_hz: its mean is taken out, a Hann window laid over it, and |DFT|^2 summed over the
// frequencies above the cut and over all but 0. rate_hz: of the samples. Power is summed over curves; each T.
double high_power_percent(const std::vector<std::vector<double>>& curves, double rate_hz, double cut_hz);

// How much an animation trembles. x_t: vertices in mm, at most 100 evenly spaced ones of those that count.
//   spread_mm       RMS of |x_t - mean(x)|: the tremble of a subject that keeps still
//   jerk_mm         RMS of |x_{t+1} - 2 x_t + x_{t-1}|, mm per frame squared
//   high_percent    share of spectral power above cut_hz, the frames taken as evenly spaced
// Rows "own" and, with a truth, "truth" and "ratio" (own over truth, not in percent: 1 is right, 0 over-smoothed).
// Fewer than 3 frames have no jerk and no spectrum (NaN). rig: with it the 68 landmarks are the vertices; vertices:
// which ones count; both null = all. truth may be null.
Table jitter(const engine::Seq<MeshPoints>& points, const engine::Seq<MeshPoints>* truth, const Timeline& timeline,
             const Rig* rig, const VertexMask* vertices, const JitterOptions& options = {});

}  // namespace face::evaluate
