// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/phone_pass.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "nodes/speech/arpabet.h"
#include "nodes/speech/speech_samples.h"

namespace face::speech {
namespace {

constexpr double pause_probability = 0.1;

// States: one before each phone, one more before each word (pauses are an arc between the two) and at the end.
Grammar phone_grammar(const PhonePiece& piece) {
  Grammar grammar;
  int state = 0;
  const auto optional_pause = [&] {
    grammar.arcs.push_back({state, state + 1, "<sil>", pause_probability});
    grammar.arcs.push_back({state, state + 1, {}, 1 - pause_probability});
    ++state;
  };
  for (const auto& phones : piece.words) {
    optional_pause();
    for (const std::string& phone : phones) {
      grammar.arcs.push_back({state, state + 1, "P_" + phone, 1});
      ++state;
    }
  }
  optional_pause();
  grammar.states = state + 1;
  return grammar;
}

std::vector<PlacedPhone> align_piece(Decoder& decoder, std::span<const std::int16_t> samples, const PhonePiece& piece) {
  const auto first = std::min(static_cast<std::size_t>(piece.first_frame) * samples_per_frame, samples.size());
  const auto end = std::min(static_cast<std::size_t>(piece.end_frame) * samples_per_frame, samples.size());
  std::vector<PlacedPhone> placed;
  std::size_t word = 0, phone = 0;
  for (const DecodedWord& d : decoder.decode(phone_grammar(piece), samples.subspan(first, end - first))) {
    PlacedPhone p{"SIL", -1, piece.first_frame + d.first_frame, piece.first_frame + d.end_frame, d.score};
    if (d.word.starts_with("P_")) {
      p.label = d.word.substr(2);
      while (word < piece.words.size() && phone >= piece.words[word].size()) ++word, phone = 0;
      p.word = static_cast<int>(word);
      ++phone;
    }
    placed.push_back(std::move(p));
  }
  return placed;
}

}  // namespace

std::vector<std::vector<PlacedPhone>> place_phones(const engine::File& acoustic_model, const DecoderOptions& options,
                                                   std::span<const std::int16_t> samples,
                                                   std::span<const PhonePiece> pieces, unsigned threads,
                                                   engine::Progress& progress) {
  std::vector<std::vector<PlacedPhone>> results(pieces.size());
  std::atomic<std::size_t> next{0};
  std::mutex failing;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      Decoder decoder(acoustic_model, options);
      for (const std::string_view phone : arpabet_phones)
        decoder.add_word("P_" + std::string(phone), std::string(phone));
      for (std::size_t i = next++; i < pieces.size() && !progress.stop_requested(); i = next++)
        results[i] = align_piece(decoder, samples, pieces[i]);
    } catch (...) {
      const std::lock_guard lock(failing);
      if (!failure) failure = std::current_exception();
      next = pieces.size();
    }
  };
  std::vector<std::thread> helpers;
  for (std::size_t k = 1; k < std::min<std::size_t>(threads, pieces.size()); ++k) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace face::speech
