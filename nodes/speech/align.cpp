// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/align.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <thread>

#include "nodes/base/check.h"
#include "nodes/speech/arpabet.h"
#include "nodes/speech/phone_pass.h"
#include "nodes/speech/speech_samples.h"
#include "nodes/speech/split_stops.h"
#include "nodes/speech/transcript.h"
#include "nodes/speech/word_pass.h"

namespace face::speech {
namespace {

// What is added to the frame grid's times: a frame's window is centred 12.8 ms after its start, and the models switch
// late, but hear a closure or a pause only once the sound before it has died away. Median lags on 24 Harvard sentences
// spoken by flite's diphone voice kal, which no test of accuracy uses.
constexpr double time_offset_s = 0.010;
constexpr double closure_offset_s = -0.001;  // where a stop or an affricate begins
constexpr double pause_offset_s = -0.005;    // where a pause begins
constexpr int cut_pause_frames = 16;         // the second pass cuts in the middle of pauses at least this long
constexpr int shortest_piece_frames = 400;   // the cepstral mean of a shorter one is not to be relied on
constexpr double shortest_phone_s = 0.030;   // three states
constexpr double phone_loop_beam = 1e-30;    // wider ones find the same phones
constexpr double phone_model_weight = 2;
constexpr double place_window_s = 1.5;  // how much badly fitting speech is a place worth a warning

// The words of a piece: where they begin in the list of all words.
struct Cut {
  std::vector<PhonePiece> pieces;
  std::vector<std::size_t> first_words;
};

// A word whose phones are chosen, with its frames by the first pass.
struct ChosenWord {
  std::string word;  // empty where phones were recognised
  std::vector<std::string> phones;
  int first_frame = 0;
  int end_frame = 0;
};

std::vector<std::string> split_blanks(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> parts;
  for (std::string part; in >> part;) parts.push_back(part);
  return parts;
}

std::span<const std::int16_t> speech_range(const SpeechSamples& speech) {
  return std::span(speech.samples)
      .subspan(static_cast<std::size_t>(speech.first_frame) * samples_per_frame,
               static_cast<std::size_t>(speech.end_frame - speech.first_frame) * samples_per_frame);
}

std::vector<ChosenWord> choose_words(const Transcript& transcript, const SpeechSamples& speech,
                                     const engine::File& acoustic_model, engine::Progress& progress) {
  DecoderOptions decoding;
  decoding.frame_step = 2;  // words and pauses need no more; the second pass finds the times
  Decoder decoder(acoustic_model, decoding);
  std::vector<ChosenWord> chosen;
  for (const PlacedWord& placed : place_words(decoder, speech_range(speech), transcript.words, progress)) {
    const WordVariants& variants = transcript.words[placed.index];
    chosen.push_back({variants.word, split_blanks(variants.pronunciations[placed.variant]),
                      speech.first_frame + placed.first_frame, speech.first_frame + placed.end_frame});
  }
  return chosen;
}

// Phones without words: a run of phones between two pauses counts as one.
std::vector<ChosenWord> recognise_phones(const SpeechSamples& speech, const engine::File& acoustic_model,
                                         const engine::File* phone_model) {
  DecoderOptions decoding;
  decoding.beam = phone_loop_beam;
  decoding.phone_model_weight = phone_model_weight;
  Decoder decoder(acoustic_model, decoding);
  std::vector<ChosenWord> chosen;
  bool in_pause = true;
  for (const DecodedWord& phone : decoder.decode_phones(phone_model, speech_range(speech))) {
    const bool pause = phone.word == "SIL" || phone.word[0] == '+';
    if (!pause) {
      if (in_pause) chosen.push_back({{}, {}, speech.first_frame + phone.first_frame, 0});
      chosen.back().phones.push_back(phone.word);
      chosen.back().end_frame = speech.first_frame + phone.end_frame;
    }
    in_pause = pause;
  }
  return chosen;
}

Cut cut_at_pauses(const std::vector<ChosenWord>& words, const SpeechSamples& speech) {
  Cut cut{{PhonePiece{speech.first_frame, 0, {}}}, {0}};
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (k > 0) {
      const int pause = words[k].first_frame - words[k - 1].end_frame;
      const int middle = words[k - 1].end_frame + pause / 2;
      if (pause >= cut_pause_frames && middle - cut.pieces.back().first_frame >= shortest_piece_frames) {
        cut.pieces.back().end_frame = middle;
        cut.pieces.push_back({middle, 0, {}});
        cut.first_words.push_back(k);
      }
    }
    cut.pieces.back().words.push_back(words[k].phones);
  }
  cut.pieces.back().end_frame = speech.end_frame;
  return cut;
}

double offset_before(std::string_view label) {
  if (label == "SIL") return pause_offset_s;
  return is_stop(label) || label == "CH" || label == "JH" ? closure_offset_s : time_offset_s;
}

// One tiling of [0, duration_s] from the pieces' phones.
std::vector<Phone> join_pieces(const std::vector<std::vector<PlacedPhone>>& placed, const Cut& cut,
                               const std::vector<ChosenWord>& words, double duration_s) {
  std::vector<Phone> phones;
  for (std::size_t k = 0; k < placed.size(); ++k)
    for (const PlacedPhone& p : placed[k]) {
      const double end_s = p.end_frame * frame_s;
      if (p.label == "SIL" && !phones.empty() && phones.back().label == "SIL") {
        phones.back().end_s = end_s;
        continue;
      }
      Phone phone{p.label, 0, end_s, {}, p.label == "SIL" ? 0 : p.score};
      if (p.word >= 0) phone.word = words[cut.first_words[k] + static_cast<std::size_t>(p.word)].word;
      phones.push_back(std::move(phone));
    }
  if (phones.empty() || (phones.back().label != "SIL" && duration_s - phones.back().end_s >= shortest_phone_s))
    phones.push_back({"SIL", 0, duration_s, {}, 0});
  double start_s = 0;
  for (std::size_t i = 0; i + 1 < phones.size(); ++i) {
    phones[i].start_s = start_s;
    // The offsets differ: a phone of three frames must not get shorter by that.
    phones[i].end_s = std::max(phones[i].end_s + offset_before(phones[i + 1].label), start_s + shortest_phone_s);
    start_s = phones[i].end_s;
  }
  phones.back().start_s = start_s;
  phones.back().end_s = duration_s;
  return phones;
}

double mean_score(std::span<const Phone> phones) {
  double sum = 0, time_s = 0;
  for (const Phone& phone : phones) {
    if (phone.label == "SIL") continue;
    sum += phone.score * (phone.end_s - phone.start_s);
    time_s += phone.end_s - phone.start_s;
  }
  return time_s > 0 ? sum / time_s : 0;
}

std::string seconds(double time_s) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << time_s << " s";
  return out.str();
}

// The stretches of at least place_window_s whose mean score is below the limit, as sentences.
std::vector<std::string> bad_places(std::span<const Phone> phones, double limit) {
  std::vector<std::string> places;
  std::size_t first = 0, bad_first = 0, bad_end = 0;
  const auto report = [&] {
    if (bad_end == bad_first) return;
    std::string words;
    for (std::size_t i = bad_first; i < bad_end; ++i)
      if (!phones[i].word.empty() && (i == bad_first || phones[i - 1].word != phones[i].word))
        words += (words.empty() ? "" : " ") + phones[i].word;
    if (words.size() > 80) words = words.substr(0, 77) + "...";
    places.push_back(message("the text does not fit the sound from ", seconds(phones[bad_first].start_s), " to ",
                             seconds(phones[bad_end - 1].end_s), " (\"", words, "\")"));
  };
  for (std::size_t end = 1; end <= phones.size(); ++end) {
    while (first + 1 < end && phones[end - 1].end_s - phones[first + 1].start_s >= place_window_s) ++first;
    const auto window = phones.subspan(first, end - first);
    if (window.back().end_s - window.front().start_s < place_window_s || mean_score(window) >= limit) continue;
    if (bad_end > bad_first && first <= bad_end) {
      bad_end = end;
      continue;
    }
    report();
    bad_first = first;
    bad_end = end;
  }
  report();
  return places;
}

// Pauses of at least half a second that are as loud as speech, as sentences: the text has no words for them. Noise does
// not count: what is that loud must stand out from the quietest tenth of the recording.
std::vector<std::string> wordless_speech(std::span<const Phone> phones, const SpeechSamples& speech) {
  constexpr double shortest_s = 0.5, above_floor = 16, below_speech = 16;  // 12 dB as ratios of energy
  std::vector<double> energy(speech.samples.size() / samples_per_frame);
  for (std::size_t i = 1; i < energy.size() * samples_per_frame; ++i) {
    const double d = double{1} * speech.samples[i] - speech.samples[i - 1];
    energy[i / samples_per_frame] += d * d;
  }
  std::vector<double> sorted = energy;
  std::sort(sorted.begin(), sorted.end());
  const double floor = sorted.empty() ? 0 : sorted[sorted.size() / 10];
  const auto level = [&](bool pause, double from_s, double to_s) {
    double sum = 0, count = 0;
    for (const Phone& phone : phones) {
      if ((phone.label == "SIL") != pause || phone.start_s < from_s || phone.end_s > to_s) continue;
      const auto last = std::min(static_cast<std::size_t>(phone.end_s / frame_s), energy.size());
      for (auto f = static_cast<std::size_t>(phone.start_s / frame_s); f < last; ++f) sum += energy[f], ++count;
    }
    return count > 0 ? sum / count : 0;
  };
  const double spoken = level(false, 0, INFINITY);
  std::vector<std::string> places;
  for (const Phone& phone : phones) {
    if (phone.label != "SIL" || phone.end_s - phone.start_s < shortest_s) continue;
    const double loudness = level(true, phone.start_s, phone.end_s);
    if (loudness > above_floor * floor && loudness * below_speech > spoken)
      places.push_back(
          message("the text has no words for the sound from ", seconds(phone.start_s), " to ", seconds(phone.end_s)));
  }
  return places;
}

}  // namespace

AlignResult align(const Audio& audio, const std::string* text, const engine::File& acoustic_model,
                  const engine::File& dictionary, const engine::File* phone_model, const AlignOptions& options,
                  engine::Progress& progress) {
  check(!audio.samples.empty(), "the audio is empty: there is nothing to align");
  check(audio.rate_hz == 16000, "the audio has ", audio.rate_hz, " Hz, expected 16000 Hz");
  for (std::size_t i = 0; i < audio.samples.size(); ++i)
    check(std::isfinite(audio.samples[i]), "sample ", i, " of the audio is not a number");
  AlignResult result;
  std::vector<std::string> warnings;
  const Transcript transcript = text ? read_transcript(*text, dictionary) : Transcript{};
  warnings = transcript.notes;
  const bool has_words = !transcript.words.empty();
  if (text && !has_words) warnings.push_back("the text has no words: phones are recognised from the sound");
  const SpeechSamples speech = prepare_samples(audio);

  std::vector<ChosenWord> words;
  if (!speech.silent && has_words) words = choose_words(transcript, speech, acoustic_model, progress);
  if (!speech.silent && !has_words) words = recognise_phones(speech, acoustic_model, phone_model);
  std::vector<std::vector<PlacedPhone>> placed;
  const Cut cut = cut_at_pauses(words, speech);
  if (!words.empty())
    placed =
        place_phones(acoustic_model, {}, speech.samples, cut.pieces, std::thread::hardware_concurrency(), progress);

  const double duration_s = audio.duration_s();
  std::vector<Phone> phones = join_pieces(placed, cut, words, duration_s);
  result.mean_score = mean_score(phones);
  if (has_words) {
    if (speech.silent)
      warnings.push_back("the audio is silent: no word of the text was placed");
    else if (words.size() < transcript.words.size())
      warnings.push_back(message(transcript.words.size() - words.size(), " of ", transcript.words.size(),
                                 " words find no room in the audio, from \"", transcript.words[words.size()].word,
                                 "\""));
    const std::vector<std::string> places = bad_places(phones, options.match_score);
    const std::vector<std::string> wordless = wordless_speech(phones, speech);
    result.matches =
        words.size() == transcript.words.size() && result.mean_score >= options.match_score && wordless.empty();
    warnings.insert(warnings.end(), places.begin(), places.end());
    warnings.insert(warnings.end(), wordless.begin(), wordless.end());
  }
  if (!has_words && speech.silent) warnings.push_back("the audio is silent: no phone was recognised");
  result.phones = split_stops({std::move(phones), duration_s, has_words}, &audio);
  for (const std::string& warning : warnings) {
    progress.warn(warning);
    result.report += warning + "\n";
  }
  return result;
}

}  // namespace face::speech
