// SPDX-License-Identifier: Apache-2.0
// What the benchmarks work on: flite speech of any length, and the two heads.
#pragma once
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "nodes/speech/say.h"

namespace bench {

struct Speech {
  face::Audio audio;
  face::Phones phones;  // the synthesiser's own times
  std::string text;
};

// Sentence after sentence until the speech is `least_s` long.
inline Speech speech_of(double least_s) {
  constexpr std::array<const char*, 6> lines = {
      "The birch canoe slid on the smooth planks.",      "Glue the sheet to the dark blue background.",
      "It's easy to tell the depth of a well.",          "These days a chicken leg is a rare dish.",
      "Four hours of steady work faced us, then lunch.", "A large size in stockings is hard to sell.",
  };
  engine::Progress progress;
  Speech speech;
  for (std::size_t i = 0; speech.audio.duration_s() < least_s; ++i) {
    const face::speech::SayResult said = face::speech::say(lines[i % lines.size()], nullptr, {}, progress);
    const double start_s = speech.audio.duration_s();
    for (face::Phone phone : said.phones.phones) {
      phone.start_s += start_s;
      phone.end_s += start_s;
      speech.phones.phones.push_back(phone);
    }
    speech.audio.samples.insert(speech.audio.samples.end(), said.audio.samples.begin(), said.audio.samples.end());
    speech.phones.duration_s = speech.audio.duration_s();
    speech.text += std::string(lines[i % lines.size()]) + " ";
  }
  return speech;
}

// The ICT-FaceKit folder of the real material; it may be absent.
inline std::filesystem::path ict_folder() {
  const char* set = std::getenv("FACEGRAPH_DATA");
  const std::filesystem::path data =
      set ? std::filesystem::path(set) : std::filesystem::path(FACEGRAPH_SOURCE_DIR) / ".." / "shared" / "data";
  return data / "ict-face" / "FaceXModel";
}

}  // namespace bench
