// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/audio.h"
#include "nodes/types/phones.h"

namespace face::speech {

// Splits every P B T D K G into closure and release ("P.c", "P.r") at the burst: the largest rise of high-band energy
// inside the segment. Without audio, or where the segment is too short to look, the closure takes 60 %. The closure is
// at most 150 ms: what an aligner gave it beyond that goes to a pause before it, else to the release. Phones that are
// split already stay as they are.
Phones split_stops(const Phones& phones, const Audio* audio);

}  // namespace face::speech
