// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/speech/flite_session.h"
#include "nodes/types/audio.h"
#include "nodes/types/phones.h"

namespace face::speech {

struct SayOptions {
  Voice voice = Voice::slt;
  double duration_stretch = 1;  // 2 speaks at half the speed
};

struct SayResult {
  Audio audio;    // 16 kHz
  Phones phones;  // the synthesiser's own times, stops split at the burst
};

// Speaks a text with flite (Black and Lenzo, Flite: a small fast run-time synthesis engine, 4th ISCA Workshop on Speech
// Synthesis, 2001). The phone times are exact: they are what the synthesiser was told to make. Characters
// that English lacks are left out with a warning. Throws on a text without anything to say.
// dictionary: CMU format, may be null; words that it lacks are warned of, with the phones that were spoken for them.
SayResult say(const std::string& text, const engine::File* dictionary, const SayOptions& options,
              engine::Progress& progress);

}  // namespace face::speech
