// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/read_dictionary.h"

#include <fstream>
#include <sstream>

#include "nodes/base/check.h"
#include "nodes/speech/arpabet.h"

namespace face::speech {

Pronunciations read_dictionary(const engine::File& dictionary, const std::set<std::string, std::less<>>& wanted) {
  std::ifstream in(dictionary.path(), std::ios::binary);
  check(in.is_open() && !dictionary.is_folder(), "cannot open the dictionary ", dictionary.path());
  Pronunciations found;
  std::string line, lower;
  std::size_t number = 0, entries = 0;
  while (std::getline(in, line)) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.starts_with(";;;") || line[0] == '#') continue;
    const std::size_t blank = line.find_first_of(" \t");
    check(line.find('\0') == std::string::npos, dictionary.name(), ":", number,
          ": found a byte 0, expected the text of a dictionary: a word and its phones");
    check(blank != std::string::npos && blank > 0, dictionary.name(), ":", number, ": found \"", line.substr(0, 40),
          "\", expected a word and its phones");
    ++entries;
    std::string_view word(line.data(), blank);
    if (word.ends_with(")"))
      if (const std::size_t open = word.find('(', 1); open != std::string_view::npos) word = word.substr(0, open);
    lower.clear();
    for (const char c : word) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (!wanted.contains(lower)) continue;
    std::istringstream phones(line.substr(blank));
    std::string phone, pronunciation;
    while (phones >> phone && phone[0] != '#') {
      const std::string label = arpabet_label(phone);
      check(!label.empty() && label != "SIL", dictionary.name(), ":", number, ": found the phone \"", phone, "\" in \"",
            lower, "\", expected one of the CMU dictionary's 39");
      pronunciation += (pronunciation.empty() ? "" : " ") + label;
    }
    check(!pronunciation.empty(), dictionary.name(), ":", number, ": \"", lower, "\" has no phones");
    found[lower].push_back(std::move(pronunciation));
  }
  check(entries > 0, "the dictionary ", dictionary.name(), " is empty: expected lines such as \"hello HH AH L OW\"");
  return found;
}

}  // namespace face::speech
