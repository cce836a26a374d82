// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace face::speech {

enum class Voice { slt, rms, awb, kal };  // US female, US male, Scottish male, US male (diphones)

// A phone as flite names it, and the word it belongs to (empty in pauses).
struct SpokenPhone {
  std::string name;
  std::string word;
  double end_s = 0;
};

struct SpokenUtterance {
  double rate_hz = 0;
  std::vector<std::int16_t> samples;
  std::vector<SpokenPhone> phones;
};

// The calls into flite. Its voices and lexicon are process-wide C objects that are made on first use without a lock, so
// all calls are serialised here; what they return depends on the arguments alone.
SpokenUtterance flite_speak(const std::string& text, Voice voice, double stretch);

// flite's pronunciation of a lower-case word: its lexicon, else letter-to-sound rules. Phones as flite names them, with
// stress digits.
std::vector<std::string> flite_pronounce(const std::string& word);

}  // namespace face::speech
