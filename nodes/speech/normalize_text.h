// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace face::speech {

struct NormalizedText {
  std::vector<std::string> words;     // lower case, letters and apostrophes only
  std::vector<std::string> warnings;  // characters that were dropped
};

// The words a US English reader would say: punctuation goes, hyphens part words, numbers are spelled out (42,
// 1,250, 3.5, 1984 as a year, 21st, 10:30, $5, 80 %), titles and symbols are expanded (Mr. Dr. & + % @), acronyms
// without a vowel are spelled ("TV", "BBC"), accents are removed. text: UTF-8. Characters of other scripts are dropped
// with a warning.
NormalizedText normalize_text(std::string_view text);

// The text in ASCII: accents go, typographic quotes, dashes and blanks become plain ones. Characters of other scripts
// become blanks, with a warning.
std::string ascii_text(std::string_view text, std::vector<std::string>& warnings);

// 0 <= number < 10^15 in words: 342 -> "three hundred forty two".
std::vector<std::string> number_words(long long number);

}  // namespace face::speech
