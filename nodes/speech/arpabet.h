// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>
#include <string_view>

namespace face::speech {

// The 39 phones of the CMU dictionary, without stress.
inline constexpr std::array<std::string_view, 39> arpabet_phones = {
    "AA", "AE", "AH", "AO", "AW", "AY", "B", "CH", "D", "DH", "EH", "ER", "EY", "F",  "G", "HH", "IH", "IY", "JH", "K",
    "L",  "M",  "N",  "NG", "OW", "OY", "P", "R",  "S", "SH", "T",  "TH", "UH", "UW", "V", "W",  "Y",  "Z",  "ZH"};

// A phone in the project's spelling: upper case, no stress digit, reduced vowels as the dictionary writes them (AX ->
// AH), pauses and breaths as SIL (also "", "sp", "spn", "pau", "<sil>"), flaps as T. Closure and release keep their
// ending
// ("p.c" -> "P.c"). Empty where it is not a phone of American English.
std::string arpabet_label(std::string_view label);

// True for P B T D K G.
bool is_stop(std::string_view label);

}  // namespace face::speech
