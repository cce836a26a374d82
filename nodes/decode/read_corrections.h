// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"

namespace face::decode {

// Reads points that somebody put right in a few frames: [{"frame": 41, "point": "lip_3", "xy": [x, y]}, ...], in any
// order, in pixels. Returns one element per frame that has corrections; its id is the frame's number, ascending.
engine::Seq<Landmarks> read_corrections(const engine::File& file);

}  // namespace face::decode
