// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/read_phones.h"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/phones_json.h"
#include "nodes/base/text_grid.h"
#include "nodes/speech/arpabet.h"
#include "nodes/speech/phone_files.h"
#include "nodes/speech/split_stops.h"

namespace face::speech {
namespace {

constexpr double rounding_s = 0.0015;    // files that round to 1 ms overlap by as much
constexpr double beyond_audio_s = 0.05;  // what an alignment may last longer than its audio

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

const TextGridTier* find_tier(const TextGrid& grid, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (const TextGridTier& tier : grid.tiers)
      if (lower_case(tier.name) == name || lower_case(tier.name).ends_with(std::string("- ") + name)) return &tier;
  return nullptr;
}

Phones from_text_grid(const TextGrid& grid, const std::string& name) {
  const TextGridTier* tier = find_tier(grid, {"phones", "phone", "segments", "mau"});
  if (!tier) {
    std::string found;
    for (const TextGridTier& t : grid.tiers) found += (found.empty() ? "\"" : ", \"") + t.name + "\"";
    fail(name, ": found the tiers ", found.empty() ? "(none)" : found, ", expected one named \"phones\"");
  }
  const TextGridTier* words = find_tier(grid, {"words", "word", "ort"});
  Phones phones;
  phones.duration_s = grid.end_s;
  for (const TextGridInterval& interval : tier->intervals) {
    Phone phone{interval.text, interval.start_s, interval.end_s, {}, 0};
    const double middle_s = (interval.start_s + interval.end_s) / 2;
    if (words)
      for (const TextGridInterval& word : words->intervals)
        if (word.start_s <= middle_s && middle_s < word.end_s) phone.word = lower_case(word.text);
    phones.phones.push_back(std::move(phone));
  }
  return phones;
}

constexpr const char* known_files = ".TextGrid, phones.json, Rhubarb's .json, TIMIT's .phn, GRID's .align";

// By the suffix; a TextGrid and a JSON file are told by what they say.
Phones parse(const std::string& bytes, const std::string& lower_suffix, const std::string& suffix,
             const std::string& name) {
  if (lower_suffix == ".textgrid" || bytes.starts_with("File type = \"ooTextFile"))
    return from_text_grid(parse_text_grid(bytes, name), name);
  if (lower_suffix == ".json")
    return bytes.find("\"mouthCues\"") != std::string::npos ? parse_rhubarb(bytes, name)
                                                            : parse_phones_json(bytes, name);
  if (lower_suffix == ".phn") return parse_timit(bytes, name);
  if (lower_suffix == ".align") return parse_grid_align(bytes, name);
  fail(name, ": found the suffix \"", suffix, "\", expected one of ", known_files,
       "; Praat and the Montreal aligner can write a TextGrid of other alignments");
}

// Normalises labels, closes gaps with silence, joins silences; the result tiles [0, duration_s].
Phones normalize(const Phones& raw, double duration_s, const std::string& name) {
  Phones phones;
  phones.duration_s = duration_s;
  double at_s = 0;
  const auto add = [&](std::string label, double end_s, const std::string& word, double score) {
    if (end_s <= at_s) return;
    if (label == "SIL" && !phones.phones.empty() && phones.phones.back().label == "SIL")
      phones.phones.back().end_s = end_s;
    else
      phones.phones.push_back({std::move(label), at_s, end_s, word, score});
    at_s = end_s;
  };
  for (const Phone& phone : raw.phones) {
    std::string label = arpabet_label(phone.label);
    check(!label.empty(), name, ": found the phone \"", phone.label, "\" at ", phone.start_s,
          " s, expected ARPAbet (AA to ZH) or silence");
    check(phone.start_s >= at_s - rounding_s, name, ": found \"", phone.label, "\" from ", phone.start_s,
          " s, expected no less than ", at_s, " s, where the segment before it ends");
    if (phone.start_s > at_s + rounding_s) add("SIL", phone.start_s, {}, 0);
    const bool pause = label == "SIL";
    add(std::move(label), std::min(phone.end_s, duration_s), pause ? std::string() : phone.word,
        pause ? 0 : phone.score);
  }
  if (duration_s > at_s + rounding_s || phones.phones.empty())
    add("SIL", duration_s, {}, 0);
  else
    phones.phones.back().end_s = duration_s;
  return phones;
}

}  // namespace

Phones read_phones(const engine::File& file, const Audio* audio) {
  std::string bytes;
  if (file.in_memory()) {
    bytes = file.bytes();
  } else {
    std::ifstream in(file.path(), std::ios::binary);
    check(in.is_open() && !file.is_folder(), "cannot open ", file.path(), ": expected an alignment (", known_files,
          ")");
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string name = file.in_memory() ? "alignment" + file.suffix() : file.name();
  const Phones raw = parse(bytes, lower_case(file.suffix()), file.suffix(), name);
  check(!raw.phones.empty(), name, ": found no phones");
  if (audio)
    check(raw.phones.back().end_s <= audio->duration_s() + beyond_audio_s, name, ": the phones end at ",
          raw.phones.back().end_s, " s, but the audio at ", audio->duration_s(), " s");
  Phones phones = split_stops(normalize(raw, audio ? audio->duration_s() : raw.duration_s, name), audio);
  phones.confident = raw.confident;
  return phones;
}

}  // namespace face::speech
