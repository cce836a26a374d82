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
// One row, named after the shape: leakage_percent; by_chance_percent, which so many coefficients of pure noise explain
// on average (components / (frames - 1)); frames. NaN where the movement never changes.
Table measure_leakage(const engine::Seq<Weights>& coefficients, const engine::Seq<Weights>& truth,
                      const MeasureLeakageOptions& options = {});

}  // namespace face::model
