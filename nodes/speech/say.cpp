// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/say.h"

#include <algorithm>
#include <cctype>

#include "nodes/base/check.h"
#include "nodes/speech/arpabet.h"
#include "nodes/speech/normalize_text.h"
#include "nodes/speech/split_stops.h"

namespace face::speech {
namespace {

constexpr double speech_rate_hz = 16000;

Phones to_phones(const SpokenUtterance& spoken, double duration_s) {
  Phones result;
  result.duration_s = duration_s;
  double start_s = 0;
  for (const SpokenPhone& spoken_phone : spoken.phones) {
    const double end_s = std::min(spoken_phone.end_s, duration_s);
    std::string label = arpabet_label(spoken_phone.name);
    check(!label.empty(), "flite spoke a phone that is not ARPAbet: ", spoken_phone.name);
    if (end_s <= start_s) continue;
    if (label == "SIL" && !result.phones.empty() && result.phones.back().label == "SIL") {
      result.phones.back().end_s = end_s;
    } else {
      const bool pause = label == "SIL";
      result.phones.push_back({std::move(label), start_s, end_s, pause ? std::string() : spoken_phone.word, 0});
    }
    start_s = end_s;
  }
  if (!result.phones.empty() && result.phones.back().label == "SIL")
    result.phones.back().end_s = duration_s;
  else if (start_s < duration_s)
    result.phones.push_back({"SIL", start_s, duration_s, {}, 0});
  return result;
}

}  // namespace

SayResult say(const std::string& text, const SayOptions& options, engine::Progress& progress) {
  std::vector<std::string> warnings;
  const std::string plain = ascii_text(text, warnings);
  for (const std::string& warning : warnings) progress.warn(warning);
  check(std::any_of(plain.begin(), plain.end(), [](unsigned char c) { return std::isalnum(c) != 0; }),
        "nothing to say: the text \"", text, "\" has no letter and no digit");
  check(options.duration_stretch > 0, "duration_stretch is ", options.duration_stretch, ", expected more than 0");
  const SpokenUtterance spoken = flite_speak(plain, options.voice, options.duration_stretch);
  check(spoken.rate_hz == speech_rate_hz, "flite spoke at ", spoken.rate_hz, " Hz, expected ", speech_rate_hz);
  SayResult result;
  result.audio.rate_hz = spoken.rate_hz;
  result.audio.samples.reserve(spoken.samples.size());
  for (const std::int16_t sample : spoken.samples)
    result.audio.samples.push_back(static_cast<float>(sample) / 32768.0F);
  result.phones = split_stops(to_phones(spoken, result.audio.duration_s()), &result.audio);
  return result;
}

}  // namespace face::speech
