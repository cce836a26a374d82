// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace face::speech {

// A pronunciation for a word that the dictionary lacks, in ARPAbet without stress: flite's lexicon and its
// letter-to-sound trees (Black, Lenzo, Pagel: Issues in Building General Letter to Sound Rules, ESCA Workshop on Speech
// Synthesis 1998). A possessive "'s" follows the base word's last phone. word: lower case letters and apostrophes.
// Never empty for a word with a letter in it.
std::vector<std::string> letter_to_sound(std::string_view word);

}  // namespace face::speech
