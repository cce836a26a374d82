// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/visemes.h"

namespace face::trajectory {

// Reads a viseme table (JSON; graphs/speech/visemes.json documents itself). It must hold the 39 phones of the CMU
// dictionary, SIL, and closure and release of P B T D K G; CH.c, CH.r, JH.c and JH.r may be there. Shape names are
// ARKit's; one without Left/Right means both sides. Throws with the place in the file ("/visemes/AA/weights/jawOpne"),
// what was found there, what was expected and the nearest name.
Visemes read_visemes(const engine::File& file);

}  // namespace face::trajectory
