// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/fit_phones.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/speech/arpabet.h"
#include "nodes/speech/phone_pass.h"
#include "nodes/speech/speech_samples.h"

namespace face::speech {
namespace {

constexpr double cut_pause_s = 0.16;      // as speech.align cuts
constexpr double shortest_piece_s = 4.0;  // the cepstral mean of a shorter one is not to be relied on

// One phone of the acoustic model: one label, or the closure and the release of a stop.
struct Unit {
  std::string phone;
  std::size_t first, end;  // labels
};

std::vector<Unit> units_of(const std::vector<Phone>& labels) {
  std::vector<Unit> units;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string& label = labels[i].label;
    if (label == "SIL") continue;
    const std::string phone = label.substr(0, label.find('.'));
    check(std::find(arpabet_phones.begin(), arpabet_phones.end(), phone) != arpabet_phones.end(), "phone ", i, " is \"",
          label, "\", expected SIL or one of the 39 of the CMU dictionary");
    const bool release = label == phone + ".r" && i > 0 && labels[i - 1].label == phone + ".c";
    if (release)
      units.back().end = i + 1;
    else
      units.push_back({phone, i, i + 1});
  }
  return units;
}

}  // namespace

FitPhonesResult fit_phones(const Audio& audio, const Phones& phones, const engine::File& acoustic_model,
                           engine::Progress& progress) {
  check(!audio.samples.empty(), "the audio is empty: no label fits it");
  check(audio.rate_hz == 16000, "the audio has ", audio.rate_hz, " Hz, expected 16000 Hz");
  for (std::size_t i = 0; i < audio.samples.size(); ++i)
    check(std::isfinite(audio.samples[i]), "sample ", i, " of the audio is not a number");
  const std::vector<Phone>& labels = phones.phones;
  for (std::size_t i = 0; i < labels.size(); ++i)
    check(std::isfinite(labels[i].start_s) && std::isfinite(labels[i].end_s) && labels[i].start_s >= 0, "phone ", i,
          " is from ", labels[i].start_s, " s to ", labels[i].end_s, " s, expected times from 0");
  FitPhonesResult result{phones, {labels.size(), 1, std::vector<double>(labels.size(), 0)}};
  for (Phone& phone : result.scored.phones) phone.score = 0;
  const std::vector<Unit> units = units_of(labels);
  if (units.empty()) return result;

  // A label may end after the sound.
  const auto frame = [](double time_s) { return static_cast<int>(std::lround(std::min(time_s, 1e6) / frame_s)); };
  std::vector<PhonePiece> pieces = {{0, 0, {{}}}};
  std::vector<std::size_t> first_unit = {0};
  for (std::size_t u = 0; u < units.size(); ++u) {
    if (u > 0) {
      const Phone &before = labels[units[u - 1].end - 1], &here = labels[units[u].first];
      const double middle_s = (before.end_s + here.start_s) / 2;
      if (here.start_s - before.end_s >= cut_pause_s &&
          middle_s - pieces.back().first_frame * frame_s >= shortest_piece_s) {
        pieces.back().end_frame = frame(middle_s);
        pieces.push_back({frame(middle_s), 0, {{}}});
        first_unit.push_back(u);
      } else if (here.word != before.word || units[u].first > units[u - 1].end) {
        pieces.back().words.emplace_back();
      }
    }
    pieces.back().words.back().push_back(units[u].phone);
  }
  pieces.back().end_frame = std::max(frame(audio.duration_s()), pieces.back().first_frame);
  first_unit.push_back(units.size());
  // A piece that begins after the sound's end, or is too short for three states of every phone, cannot be placed.
  const SpeechSamples speech = prepare_samples(audio);
  std::vector<PhonePiece> placeable;
  std::vector<std::size_t> which;
  const int end_frame = frame(audio.duration_s());
  for (std::size_t k = 0; k < pieces.size() && !speech.silent; ++k) {
    pieces[k].end_frame = std::min(pieces[k].end_frame, end_frame);
    const auto count = static_cast<int>(first_unit[k + 1] - first_unit[k]);
    if (pieces[k].end_frame - pieces[k].first_frame < 3 * count) continue;
    placeable.push_back(pieces[k]);
    which.push_back(k);
  }
  std::vector<std::vector<PlacedPhone>> placed(pieces.size());
  if (!placeable.empty()) {
    std::vector<std::vector<PlacedPhone>> found =
        place_phones(acoustic_model, {}, speech.samples, placeable, std::thread::hardware_concurrency(), progress);
    for (std::size_t i = 0; i < which.size(); ++i) placed[which[i]] = std::move(found[i]);
  }
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    std::erase_if(placed[k], [](const PlacedPhone& p) { return p.label == "SIL"; });
    const bool whole = placed[k].size() == first_unit[k + 1] - first_unit[k];
    for (std::size_t u = first_unit[k]; u < first_unit[k + 1]; ++u) {
      const PlacedPhone* const heard = whole ? &placed[k][u - first_unit[k]] : nullptr;
      const double middle_s = (labels[units[u].first].start_s + labels[units[u].end - 1].end_s) / 2;
      for (std::size_t i = units[u].first; i < units[u].end; ++i) {
        result.scored.phones[i].score = heard ? heard->score : unplaced_score;
        if (heard)
          result.apart_s.values[i] = std::abs((heard->first_frame + heard->end_frame) * frame_s / 2 - middle_s);
      }
    }
  }
  return result;
}

}  // namespace face::speech
