// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/audio.h"
#include "nodes/types/matrix.h"
#include "nodes/types/phones.h"

namespace face::speech {

// Score of a phone that finds no room where the labels have it; no sound is that unlike a phone.
inline constexpr double unplaced_score = -100;

struct FitPhonesResult {
  Phones scored;   // the labels as they are, each with its score; pauses have 0
  Matrix apart_s;  // N x 1: from the middle of each phone to where the sound has it; 0 for pauses and where there is no
                   // room
};

// How well labels fit a recording: their phones, in their order, are aligned to the stretches of sound between the
// labels' own pauses (the second pass of speech.align), and each is scored as there: mean log likelihood per frame,
// relative to the best state. Clean speech has -3 to -1 with its own labels, other words have -7 to -4.5.
// audio: 16 kHz. phones: ARPAbet, stops whole or as closure and release. acoustic_model: a PocketSphinx model folder
// with the CMU phones.
FitPhonesResult fit_phones(const Audio& audio, const Phones& phones, const engine::File& acoustic_model,
                           engine::Progress& progress);

}  // namespace face::speech
