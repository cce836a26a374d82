// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/speech/word_pass.h"

namespace face::speech {

// A text as words with their pronunciations, and what a user should know of how it was read.
struct Transcript {
  std::vector<WordVariants> words;
  std::vector<std::string> notes;
};

// Normalises the text and looks its words up; those that the dictionary lacks get letter-to-sound and a note.
Transcript read_transcript(const std::string& text, const engine::File& dictionary);

}  // namespace face::speech
