// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::model {

struct RetimeWeightsOptions {
  double delay_s = 0;  // of the weights against the clip
};

// Weights for every frame of a clip, from weights at another rate: linear between the two moments around, the first and
// the last beyond them.
void retime_weights(const engine::Seq<Weights>& weights, const Timeline& timeline, const Timeline& clip,
                    engine::SeqWriter<Weights>& retimed, const RetimeWeightsOptions& options = {});

}  // namespace face::model
