// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/phone_files.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/speech/arpabet.h"
#include "nodes/speech/letter_to_sound.h"

namespace face::speech {
namespace {

constexpr double timit_rate_hz = 16000;
constexpr double grid_units_per_s = 25000;

struct Line {
  long begin = 0, end = 0;
  std::string label;
  std::size_t number = 0;
};

std::string_view next_word(std::string_view& text) {
  const std::size_t start = text.find_first_not_of(" \t\r");
  if (start == std::string_view::npos) return text = {};
  const std::size_t end = std::min(text.find_first_of(" \t\r", start), text.size());
  const std::string_view word = text.substr(start, end - start);
  text.remove_prefix(end);
  return word;
}

// Lines "begin end label"; empty ones are skipped.
std::vector<Line> lines_of(std::string_view text, const std::string& name, const char* what) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view whole = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::string_view rest = whole;
    const std::string_view first = next_word(rest);
    if (first.empty()) continue;
    const std::string_view second = next_word(rest), label = next_word(rest);
    Line line;
    line.number = number;
    line.label = label;
    const auto whole_number = [](std::string_view word, long& value) {
      const auto [at, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      return error == std::errc() && at == word.data() + word.size();
    };
    if (!whole_number(first, line.begin) || !whole_number(second, line.end) || label.empty() ||
        !next_word(rest).empty())
      fail(name, ":", number, ": found \"", whole.substr(0, 60), "\", expected ", what);
    check(line.begin >= 0 && line.end >= line.begin, name, ":", number, ": found ", line.begin, " to ", line.end,
          ", expected an end after its begin");
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

bool is_vowel(const std::string& phone) { return std::string_view("AEIOU").find(phone[0]) != std::string_view::npos; }

}  // namespace

Phones parse_timit(std::string_view text, const std::string& name) {
  const std::vector<Line> lines =
      lines_of(text, name, "begin and end in samples and a phone, such as \"2480 3400 sh\"");
  Phones phones;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double start_s = static_cast<double>(lines[i].begin) / timit_rate_hz;
    const double end_s = static_cast<double>(lines[i].end) / timit_rate_hz;
    const std::string label = lower_case(lines[i].label),
                      next = i + 1 < lines.size() ? lower_case(lines[i + 1].label) : "";
    phones.duration_s = end_s;
    if (label.size() == 3 && label.ends_with("cl") && is_stop(arpabet_label(label.substr(0, 1)))) {
      const std::string stop = arpabet_label(label.substr(0, 1));
      if (lower_case(stop) == next)
        phones.phones.push_back({stop + ".c", start_s, end_s, {}, 0});
      else if ((label == "tcl" && next == "ch") || (label == "dcl" && next == "jh"))
        phones.phones.push_back({arpabet_label(next), start_s, end_s, {}, 0});
      else
        phones.phones.push_back({stop, start_s, end_s, {}, 0});
      continue;
    }
    Phone* before = phones.phones.empty() ? nullptr : &phones.phones.back();
    const std::string ours = label == "q" ? "SIL" : arpabet_label(label);
    if (before && before->label == ours + ".c")
      phones.phones.push_back({ours + ".r", start_s, end_s, {}, 0});
    else if (before && (ours == "CH" || ours == "JH") && before->label == ours && before->end_s == start_s)
      before->end_s = end_s;
    else
      phones.phones.push_back({ours.empty() ? lines[i].label : ours, start_s, end_s, {}, 0});
  }
  return phones;
}

Phones parse_grid_align(std::string_view text, const std::string& name) {
  const std::vector<Line> lines =
      lines_of(text, name, "begin and end in 1/25000 s and a word, such as \"0 12250 sil\"");
  Phones phones;
  phones.confident = false;
  for (const Line& line : lines) {
    const std::string word = lower_case(line.label);
    const double start_s = static_cast<double>(line.begin) / grid_units_per_s;
    const double end_s = static_cast<double>(line.end) / grid_units_per_s;
    phones.duration_s = end_s;
    if (word == "sil" || word == "sp") {
      phones.phones.push_back({"SIL", start_s, end_s, {}, 0});
      continue;
    }
    check(word.find_first_not_of("abcdefghijklmnopqrstuvwxyz'") == std::string::npos, name, ":", line.number,
          ": found the word \"", line.label, "\", expected letters");
    const std::vector<std::string> sounds = letter_to_sound(word);
    double parts = 0, done = 0;
    for (const std::string& sound : sounds) parts += is_vowel(sound) ? 2 : 1;
    for (const std::string& sound : sounds) {
      const double from = done / parts;
      done += is_vowel(sound) ? 2 : 1;
      phones.phones.push_back(
          {sound, start_s + from * (end_s - start_s), start_s + done / parts * (end_s - start_s), word, 0});
    }
  }
  return phones;
}

Phones parse_rhubarb(std::string_view text, const std::string& name) {
  using Json = nlohmann::ordered_json;
  const Json json = Json::parse(text, nullptr, false);
  check(!json.is_discarded() && json.is_object() && json.contains("mouthCues") && json["mouthCues"].is_array(), name,
        ": expected {\"mouthCues\": [{\"start\": ..., \"end\": ..., \"value\": \"A\"}, ...]}, as Rhubarb writes it");
  static constexpr std::pair<char, const char*> shapes[] = {
      {'A', "M"}, {'B', "S"}, {'C', "EH"}, {'D', "AA"}, {'E', "AO"}, {'F', "UW"}, {'G', "F"}, {'H', "L"}, {'X', "SIL"}};
  Phones phones;
  phones.confident = false;
  const Json& cues = json["mouthCues"];
  for (std::size_t i = 0; i < cues.size(); ++i) {
    const Json& cue = cues[i];
    const auto number = [&](const char* key) {
      check(cue.is_object() && cue.contains(key) && cue[key].is_number(), name, ": /mouthCues/", i, "/", key,
            ": expected a number of seconds");
      return cue[key].get<double>();
    };
    Phone phone{{}, number("start"), number("end"), {}, 0};
    check(phone.end_s >= phone.start_s && phone.start_s >= 0, name, ": /mouthCues/", i, ": found ", phone.start_s,
          " to ", phone.end_s, " s, expected an end after its start");
    const std::string value = cue.contains("value") && cue["value"].is_string() ? cue["value"].get<std::string>() : "";
    for (const auto& [shape, label] : shapes)
      if (value.size() == 1 && value[0] == shape) phone.label = label;
    check(!phone.label.empty(), name, ": /mouthCues/", i, "/value: found ",
          cue.contains("value") ? cue["value"].dump() : "nothing", ", expected one of A to H, or X");
    phones.duration_s = phone.end_s;
    phones.phones.push_back(std::move(phone));
  }
  return phones;
}

}  // namespace face::speech
