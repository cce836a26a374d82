// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/speech/decoder.h"

namespace face::speech {

// A run of words whose phones are known, and the frames it lies in. Pieces are aligned independently of each other.
struct PhonePiece {
  int first_frame = 0;
  int end_frame = 0;
  std::vector<std::vector<std::string>> words;  // phones of each word
};

// A phone or a pause ("SIL") on the frame grid, 10 ms per frame.
struct PlacedPhone {
  std::string label;
  int word = -1;  // in the piece's words, -1 in a pause
  int first_frame = 0;
  int end_frame = 0;
  double score = 0;
};

// Aligns the phones of every piece: Viterbi over the linear phone graph, with an optional pause before each word and at
// the end. Pieces run on `threads` threads; each one's result depends on its samples and phones alone. A piece whose
// phones do not fit into its frames comes back empty. samples: 16 kHz, of the whole recording.
std::vector<std::vector<PlacedPhone>> place_phones(const engine::File& acoustic_model, const DecoderOptions& options,
                                                   std::span<const std::int16_t> samples,
                                                   std::span<const PhonePiece> pieces, unsigned threads,
                                                   engine::Progress& progress);

}  // namespace face::speech
