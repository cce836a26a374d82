// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/arpabet.h"

#include <algorithm>
#include <utility>

namespace face::speech {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 26> other_names = {{
    {"", "SIL"},     {"SP", "SIL"},  {"SPN", "SIL"},  {"PAU", "SIL"}, {"H#", "SIL"},  {"BRTH", "SIL"}, {"<SIL>", "SIL"},
    {"SSIL", "SIL"}, {"<S>", "SIL"}, {"</S>", "SIL"}, {"EPI", "SIL"}, {"#", "SIL"},   {"_", "SIL"},    {"<P:>", "SIL"},
    {"AX", "AH"},    {"AXR", "ER"},  {"IX", "IH"},    {"UX", "UW"},   {"EL", "L"},    {"EM", "M"},     {"EN", "N"},
    {"ENG", "NG"},   {"NX", "N"},    {"DX", "T"},     {"HV", "HH"},   {"AX-H", "AH"},
}};

}  // namespace

std::string arpabet_label(std::string_view label) {
  std::string name;
  for (const char c : label) name += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  if (name.size() > 2 && (name.ends_with(".C") || name.ends_with(".R"))) {
    if (!is_stop(name.substr(0, name.size() - 2))) return {};
    name.back() = name.back() == 'C' ? 'c' : 'r';
    return name;
  }
  if (name.size() > 1 && name.back() >= '0' && name.back() <= '2') name.pop_back();
  if (name == "SIL") return name;
  for (const auto& [other, ours] : other_names)
    if (name == other) return std::string(ours);
  if (std::find(arpabet_phones.begin(), arpabet_phones.end(), name) != arpabet_phones.end()) return name;
  return {};
}

bool is_stop(std::string_view label) {
  return label == "P" || label == "B" || label == "T" || label == "D" || label == "K" || label == "G";
}

}  // namespace face::speech
