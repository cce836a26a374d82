// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "nodes/types/phones.h"

namespace face::speech {

// Alignments as other programs write them, with labels that arpabet_label knows and times as they stand. name: what
// messages call the file. Each throws with name, line (or place in JSON), what was found and what was expected.

// TIMIT's .phn: lines "begin end label" in samples of 16 kHz (Garofolo et al., DARPA TIMIT, NIST 1993). A closure and
// the release after it ("bcl b") are one stop in two parts ("B.c", "B.r"); before CH and JH it is part of them; a
// closure that is never released is a whole stop. The glottal stop "q" is a pause.
Phones parse_timit(std::string_view text, const std::string& name);

// GRID's .align: lines "begin end word" in 1/25000 s (Cooke et al., An audio-visual corpus for speech perception and
// automatic speech recognition, JASA 2006). Words become the phones of letter_to_sound, each vowel twice as long as a
// consonant: words are where the file says, phones within them are a guess (confident = false).
Phones parse_grid_align(std::string_view text, const std::string& name);

// Rhubarb Lip Sync's JSON: {"mouthCues": [{"start": s, "end": s, "value": "A"}, ...]}. Every mouth shape becomes the
// phone that its manual names first for it: A M, B S, C EH, D AA, E AO, F UW, G F, H L, X silence (confident = false).
Phones parse_rhubarb(std::string_view text, const std::string& name);

}  // namespace face::speech
