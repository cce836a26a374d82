// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/letter_to_sound.h"

#include <algorithm>
#include <array>

#include "nodes/speech/arpabet.h"
#include "nodes/speech/flite_session.h"

namespace face::speech {
namespace {

void add_possessive(std::vector<std::string>& phones) {
  constexpr std::array<std::string_view, 6> hissing = {"S", "Z", "SH", "ZH", "CH", "JH"};
  constexpr std::array<std::string_view, 5> voiceless = {"P", "T", "K", "F", "TH"};
  const auto ends_in = [&](const auto& list) {
    return std::find(list.begin(), list.end(), phones.back()) != list.end();
  };
  if (ends_in(hissing)) {
    phones.emplace_back("IH");
    phones.emplace_back("Z");
  } else {
    phones.emplace_back(ends_in(voiceless) ? "S" : "Z");
  }
}

}  // namespace

std::vector<std::string> letter_to_sound(std::string_view word) {
  const bool possessive = word.size() > 2 && word.ends_with("'s");
  std::string letters;
  for (const char c : possessive ? word.substr(0, word.size() - 2) : word)
    if (c >= 'a' && c <= 'z') letters += c;
  std::vector<std::string> phones;
  if (letters.empty()) return phones;
  for (const std::string& name : flite_pronounce(letters))
    if (std::string label = arpabet_label(name); !label.empty() && label != "SIL") phones.push_back(std::move(label));
  if (phones.empty()) phones.emplace_back("AH");
  if (possessive) add_possessive(phones);
  return phones;
}

}  // namespace face::speech
