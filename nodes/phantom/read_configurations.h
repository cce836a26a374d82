// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/weights.h"

namespace face::phantom {

// Reads a list of faces to make: {"NAME": {"jawOpen": 0.4, "mouthSmile": 0.2, ...}, ...}. Names are ARKit's; one
// without Left or Right means both sides. Every face becomes 52 weights, under its name, in the file's order. Throws,
// naming file and face, for anything else.
void read_configurations(const engine::File& file, engine::SeqWriter<Weights>& weights);

}  // namespace face::phantom
