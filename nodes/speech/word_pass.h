// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/speech/decoder.h"

namespace face::speech {

// A word of the transcript with the pronunciations it may have: phones with blanks between.
struct WordVariants {
  std::string word;
  std::vector<std::string> pronunciations;
};

// Where a word was found, in frames of 10 ms.
struct PlacedWord {
  std::size_t index = 0;    // in the transcript
  std::size_t variant = 0;  // in its pronunciations
  int first_frame = 0;
  int end_frame = 0;
};

// Places the words of a transcript, in order, and chooses their pronunciations: Viterbi over the linear word graph with
// optional pauses between. Audio beyond one chunk is worked off chunk by chunk: each takes as many words as fit best
// and hands over at a pause, so that the cost is linear in the length. Words that find no room (a transcript that is
// longer than the audio can hold) are left out at the end. samples: 16 kHz.
std::vector<PlacedWord> place_words(Decoder& decoder, std::span<const std::int16_t> samples,
                                    std::span<const WordVariants> words, engine::Progress& progress);

}  // namespace face::speech
