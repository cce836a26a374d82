// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/transcript.h"

#include <set>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/speech/letter_to_sound.h"
#include "nodes/speech/normalize_text.h"
#include "nodes/speech/read_dictionary.h"

namespace face::speech {

Transcript read_transcript(const std::string& text, const engine::File& dictionary) {
  NormalizedText normalized = normalize_text(text);
  Transcript transcript;
  transcript.notes = std::move(normalized.warnings);
  const Pronunciations known =
      read_dictionary(dictionary, std::set<std::string, std::less<>>(normalized.words.begin(), normalized.words.end()));
  std::set<std::string> unknown;
  for (std::string& word : normalized.words) {
    WordVariants variants{word, {}};
    if (const auto found = known.find(word); found != known.end()) {
      variants.pronunciations = found->second;
    } else {
      std::string phones;
      for (const std::string& phone : letter_to_sound(word)) phones += (phones.empty() ? "" : " ") + phone;
      if (phones.empty()) continue;
      if (unknown.insert(word).second)
        transcript.notes.push_back(message("\"", word, "\" is not in the dictionary: taken as ", phones));
      variants.pronunciations = {phones};
    }
    transcript.words.push_back(std::move(variants));
  }
  return transcript;
}

}  // namespace face::speech
