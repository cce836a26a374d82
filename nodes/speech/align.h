// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/types/audio.h"
#include "nodes/types/phones.h"

namespace face::speech {

struct AlignOptions {
  // A transcript whose mean score is below this does not match. Clean speech that matches has -3 to -1, another
  // sentence's words have -7 to -4.5; noise lowers what matches (10 dB: -4 to -2).
  double match_score = -4;
};

struct AlignResult {
  Phones phones;          // stops as closure and release; not confident without a transcript
  double mean_score = 0;  // mean log likelihood per frame of speech, relative to the best state; lower is worse
  bool matches = true;    // false where the transcript does not fit the audio
  std::string report;     // what was done with the text, and where it does not fit; one line each
};

// When each phone of a recording is spoken. With a text: forced alignment in two passes of Viterbi decoding, words and
// their pronunciations first, then phones, with PocketSphinx 0.8 (Huggins-Daines et al., Pocketsphinx: A Free,
// Real-Time Continuous Speech Recognition System for Hand-Held Devices, ICASSP 2006) and beams left open, so that noise
// cannot lose the path. Without one, or with one that has no words: phones are recognised, with phone_model (an n-gram
// over phones) if given. audio: 16 kHz. acoustic_model: a PocketSphinx model folder with the CMU phones. dictionary:
// CMU format. Words that it lacks get letter-to-sound, with a warning. A transcript that does not fit is reported, with
// the place; words that find no room are left out. Only empty audio is refused.
AlignResult align(const Audio& audio, const std::string* text, const engine::File& acoustic_model,
                  const engine::File& dictionary, const engine::File* phone_model, const AlignOptions& options,
                  engine::Progress& progress);

}  // namespace face::speech
