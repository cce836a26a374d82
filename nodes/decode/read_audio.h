// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/audio.h"

namespace face::decode {

struct ReadAudioOptions {
  double rate_hz = 16000;  // of the result
  bool required = true;    // false: a video file without sound gives no samples
};

struct ReadAudioResult {
  Audio audio;                // mono, in [-1, 1]
  bool silent = false;        // no sample above 1/32768 (-90 dB): nothing to hear
  double source_rate_hz = 0;  // as the file has it
  double source_channels = 0;
};

// Reads a recording, or the sound of a video file: WAV, AIFF, FLAC, Ogg and more by libsndfile, the rest (M4A, MP4,
// MPEG, ...) by FFmpeg. Any rate, depth and number of channels; channels are averaged, those without any signal do not
// count (speech on one side of a stereo file, or in the centre of 5.1, keeps its level). Floating-point files above
// full scale are scaled down to it. Throws, naming the file, where it is missing, empty, truncated or of a kind that
// nothing reads.
ReadAudioResult read_audio(const engine::File& file, const ReadAudioOptions& options = {});

}  // namespace face::decode
