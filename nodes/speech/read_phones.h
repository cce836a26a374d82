// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/audio.h"
#include "nodes/types/phones.h"

namespace face::speech {

// Reads an alignment made elsewhere: a Praat TextGrid (long or short, UTF-8 or UTF-16), our phones.json, or what
// phone_files.h reads: TIMIT's .phn, GRID's .align (words; their phones are guessed) and Rhubarb's mouth shapes. Of a
// TextGrid the tier "phones" (or "phone", "segments", "MAU", or a name that ends in one, as the Montreal aligner
// writes) holds the phones and "words" ("word", "ORT") the words. Labels lose stress; "", "sp", "sil" and the like
// become SIL; gaps become SIL; stops are split at the burst if the audio is given, else at 60 %. With audio the last
// segment ends where the audio does. Throws with file, place, what was found and what was expected.
Phones read_phones(const engine::File& file, const Audio* audio);

}  // namespace face::speech
