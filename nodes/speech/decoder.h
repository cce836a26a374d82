// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/port.h"

namespace face::speech {

// An arc of a word graph. An empty word is a null transition; "<sil>" is a pause.
struct GrammarArc {
  int from = 0;
  int to = 0;
  std::string word;
  double probability = 1;
};

// A word graph from state 0 to state `states - 1`. `pauses`: states where silence may be inserted, any number of times.
struct Grammar {
  int states = 1;
  std::vector<GrammarArc> arcs;
  std::vector<int> pauses;
  double pause_probability = 0.005;
};

// A decoded word, from the start of its first frame to the end of its last one (frames of 10 ms).
struct DecodedWord {
  std::string word;
  int first_frame = 0;
  int end_frame = 0;
  double score = 0;  // mean log likelihood per frame, relative to the best active state
};

struct DecoderOptions {
  double beam = 1e-300;           // open: a path that reaches the end is never lost
  int frame_step = 1;             // densities are evaluated in every nth frame: most of the cost
  double phone_model_weight = 1;  // of the n-gram against the sound, in decode_phones
};

// PocketSphinx 0.8's Viterbi decoder over a word graph. Holds the acoustic model and the words added to it; a decode
// depends on its arguments alone. One thread at a time; several decoders may run in parallel.
class Decoder {
 public:
  // acoustic_model: a folder with mdef, means, variances, transition_matrices, sendump (or mixture_weights),
  // feat.params.
  Decoder(const engine::File& acoustic_model, const DecoderOptions& options);
  ~Decoder();
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  // pronunciation: phones with blanks between. A word that is there already is left as it is.
  void add_word(const std::string& word, const std::string& pronunciation);

  // The best path, pauses ("<sil>") included; empty where no path reaches the end. samples: 16 kHz.
  std::vector<DecodedWord> decode(const Grammar& grammar, std::span<const std::int16_t> samples);
  // The best string of phones, context-independent (triphones cost 20 times as much and are no better at it), without
  // words. phone_model: PocketSphinx n-gram model over phones, or null.
  std::vector<DecodedWord> decode_phones(const engine::File* phone_model, std::span<const std::int16_t> samples);

 private:
  struct State;
  std::vector<DecodedWord> run(std::span<const std::int16_t> samples);
  std::unique_ptr<State> state_;
};

}  // namespace face::speech
