// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/audio.h"

namespace face::speech {

// Frames of 10 ms, 160 samples each at 16 kHz: the decoder's grid.
inline constexpr int samples_per_frame = 160;
inline constexpr double frame_s = 0.010;

// A recording made ready for the decoder.
struct SpeechSamples {
  std::vector<std::int16_t> samples;  // from the recording's start; loudness brought to one level
  int first_frame = 0;                // speech lies in [first_frame, end_frame): silence beyond a margin is cut off
  int end_frame = 0;
  bool silent = false;  // nothing louder than 16-bit rounding
};

// Mean removed, scaled to one peak (so that gain and offset do not matter), with a faint fixed noise so that digital
// silence has a spectrum. audio: 16 kHz.
SpeechSamples prepare_samples(const Audio& audio);

}  // namespace face::speech
