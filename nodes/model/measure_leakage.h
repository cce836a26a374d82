// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/table.h"
#include "nodes/types/weights.h"

namespace face::model {

struct MeasureLeakageOptions {
  std::int64_t components = 15;
  std::string shape = "eyeBlinkLeft";
};

// How much of one true movement the first coefficients of a linear space tell: R^2 of the least-squares prediction of
// the ARKit weight `shape` by them and a constant, over all frames. What a mouth's space should not know is a blink.
// coefficients, truth: of every frame, with the same ids; frames without coefficients (lost) are left out.
// What such a prediction explains by coincidence is counted, not assumed, since neither a mouth nor a dozen blinks are
// independent from frame to frame: the same prediction of the movement moved round in time by each of 256 equal steps,
// so that nothing can be known of it (Theiler et al., Testing for nonlinearity in time series: the method of surrogate
// data, 1992; circular shifts keep the spectrum).
// What they know in frames that did not teach the prediction is counted as well, in each of ten runs of frames that
// follow one another by the nine others (Stone, Cross-validatory choice and assessment of statistical predictions,
// 1974): no coincidence helps there, and less than nothing is a prediction that is worse than the mean.
// One row, named after the shape: leakage_percent; by_chance_percent, the mean of those; likely_by_chance_percent,
// which one in twenty of them exceeds; frames; elsewhere_percent. NaN where the movement never changes, the last also
// where there are few frames.
Table measure_leakage(const engine::Seq<Weights>& coefficients, const engine::Seq<Weights>& truth,
                      const MeasureLeakageOptions& options = {});

}  // namespace face::model
