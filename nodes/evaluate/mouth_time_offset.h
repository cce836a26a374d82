// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "engine/port.h"
#include "nodes/types/rig.h"
#include "nodes/types/table.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

struct MouthTimeOffsetOptions {
  double prominence_mm = 0.5;  // an extremum differs by this from its neighbours, or is noise
  double max_offset_ms = 200;  // extrema farther apart are not the same event
};

// A local extremum of a curve.
struct Extremum {
  double time_s = 0;
  bool peak = true;  // else a valley
};

// Peaks and valleys in turn, each at least `prominence` from the one before and the one after; the ends of the curve
// are none. Its time is the vertex of the parabola through the sample and its two neighbours.
std::vector<Extremum> find_extrema(const std::vector<double>& values, const std::vector<double>& time_s,
                                   double prominence);

// How late the mouth's movements are (mean temporal misalignment, the idea of Chae-Yeon et al., Perceptually Accurate
// 3D Talking Head Generation, CVPR 2025; details are ours): extrema of lip motion in both animations are matched in
// their order, peaks with peaks and valleys with valleys, so that as many as possible are matched and the sum of
// offsets is least. Lip motion in y is the lip gap, in x the distance of the corners of the mouth (landmarks 48 and 54;
// without landmarks the span of the inner lip pairs). Differs from the paper: extrema are matched by themselves instead
// of over a time warp of the curves, and unmatched ones are counted. Rows "opening", "width", "both": offset_ms (mean
// size), late_ms (mean with its sign: positive = after the truth), matched (count), missing_percent (of the truth's
// extrema), extra_percent (of the animation's).
Table mouth_time_offset(const Rig& rig, const engine::Seq<Weights>& weights, const engine::Seq<Weights>& truth,
                        const Timeline& timeline, const MouthTimeOffsetOptions& options = {});

}  // namespace face::evaluate
