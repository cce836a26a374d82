// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/word_pass.h"

#include <algorithm>
#include <charconv>

#include "nodes/base/check.h"
#include "nodes/speech/speech_samples.h"

namespace face::speech {
namespace {

constexpr int whole_frames = 4500;  // decoded in one go up to here
constexpr int chunk_frames = 3000;
constexpr double words_per_frame = 0.055;  // nobody reads faster: 5.5 words per second
constexpr int handover_pause_frames = 12;
constexpr std::size_t words_dropped = 4;  // at a chunk's end, where there was no pause to hand over at

std::string entry_name(std::size_t word, std::size_t variant) { return message('w', word, '_', variant); }

// The linear graph of words [first, first + count). may_stop: the path may end after any of them.
Grammar linear_grammar(Decoder& decoder, std::span<const WordVariants> words, std::size_t first, std::size_t count,
                       bool may_stop) {
  Grammar grammar;
  grammar.states = static_cast<int>(count) + 2;
  for (std::size_t k = 0; k <= count; ++k) {
    const int state = static_cast<int>(k);
    grammar.pauses.push_back(state);
    if (may_stop || k == count) grammar.arcs.push_back({state, grammar.states - 1, {}, 1});
    if (k == count) break;
    const auto& variants = words[first + k].pronunciations;
    for (std::size_t v = 0; v < variants.size(); ++v) {
      const std::string name = entry_name(first + k, v);
      decoder.add_word(name, variants[v]);
      grammar.arcs.push_back({state, state + 1, name, 1.0 / static_cast<double>(variants.size())});
    }
  }
  return grammar;
}

std::vector<PlacedWord> placed_words(const std::vector<DecodedWord>& decoded, int frame_offset) {
  std::vector<PlacedWord> placed;
  for (const DecodedWord& d : decoded) {
    if (d.word[0] != 'w') continue;
    PlacedWord word;
    const char* end = d.word.data() + d.word.size();
    const auto [split, error] = std::from_chars(d.word.data() + 1, end, word.index);
    std::from_chars(split + 1, end, word.variant);
    word.first_frame = frame_offset + d.first_frame;
    word.end_frame = frame_offset + d.end_frame;
    placed.push_back(word);
  }
  return placed;
}

}  // namespace

std::vector<PlacedWord> place_words(Decoder& decoder, std::span<const std::int16_t> samples,
                                    std::span<const WordVariants> words, engine::Progress& progress) {
  const int frames = static_cast<int>(samples.size() / samples_per_frame);
  std::vector<PlacedWord> result;
  int frame = 0;
  std::size_t next = 0;
  while (next < words.size() && !progress.stop_requested()) {
    const auto rest = samples.subspan(static_cast<std::size_t>(frame) * samples_per_frame);
    const bool last = frames - frame <= whole_frames;
    const auto chunk = last ? rest : rest.first(static_cast<std::size_t>(chunk_frames) * samples_per_frame);
    const std::size_t left = words.size() - next;
    const std::size_t count = last ? left : std::min(left, static_cast<std::size_t>(chunk_frames * words_per_frame));
    std::vector<PlacedWord> placed;
    if (last) placed = placed_words(decoder.decode(linear_grammar(decoder, words, next, count, false), chunk), frame);
    if (placed.empty())
      placed = placed_words(decoder.decode(linear_grammar(decoder, words, next, count, true), chunk), frame);
    if (last) {
      result.insert(result.end(), placed.begin(), placed.end());
      break;
    }
    // Hand over in the last good pause of the chunk, else some words before its end.
    std::size_t keep = placed.size() > words_dropped ? placed.size() - words_dropped : 0;
    int handover = keep > 0 ? placed[keep - 1].end_frame : frame + chunk_frames;
    for (std::size_t k = placed.size(); k > placed.size() / 2 && k >= 2; --k) {
      const int pause = placed[k - 1].first_frame - placed[k - 2].end_frame;
      if (pause < handover_pause_frames) continue;
      keep = k - 1;
      handover = placed[k - 2].end_frame + pause / 2;
      break;
    }
    result.insert(result.end(), placed.begin(), placed.begin() + static_cast<std::ptrdiff_t>(keep));
    next += keep;
    frame = std::max(handover, frame + 100);
    progress.report(0.5 * frame / frames);
  }
  return result;
}

}  // namespace face::speech
