// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/say.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "nodes/base/check.h"
#include "nodes/speech/arpabet.h"
#include "nodes/speech/normalize_text.h"
#include "nodes/speech/read_dictionary.h"
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

// The text's words that the dictionary lacks, in their order, each once with the phones it was given. A possessive is
// known with its base word.
void warn_of_unknown_words(const std::string& text, const Phones& phones, const engine::File& dictionary,
                           engine::Progress& progress) {
  const std::vector<std::string> words = normalize_text(text).words;
  std::set<std::string, std::less<>> wanted(words.begin(), words.end());
  const auto base_of = [](const std::string& word) {
    return word.ends_with("'s") ? word.substr(0, word.size() - 2) : word;
  };
  for (const std::string& word : words) wanted.insert(base_of(word));
  const Pronunciations known = read_dictionary(dictionary, wanted);
  std::set<std::string> told;
  for (const std::string& word : words) {
    if (known.contains(word) || known.contains(base_of(word)) || !told.insert(word).second) continue;
    std::string spoken;
    for (std::size_t k = 0; k < phones.phones.size() && (spoken.empty() || phones.phones[k].word == word); ++k)
      if (phones.phones[k].word == word) spoken += (spoken.empty() ? "" : " ") + phones.phones[k].label;
    // flite spells what it cannot pronounce: then no spoken word is this one.
    progress.warn(message("\"", word, "\" is not in the dictionary: ",
                          spoken.empty() ? "spelled letter by letter" : "spoken as " + spoken));
  }
}

}  // namespace

SayResult say(const std::string& text, const engine::File* dictionary, const SayOptions& options,
              engine::Progress& progress) {
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
  const Phones phones = to_phones(spoken, result.audio.duration_s());
  if (dictionary) warn_of_unknown_words(plain, phones, *dictionary, progress);
  result.phones = split_stops(phones, &result.audio);
  return result;
}

}  // namespace face::speech
