// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_audio.h"

#include "engine/node.h"
#include "nodes/types/audio.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.audio", &read_audio, version{2},
     doc{"Reads a recording, or the sound of a video file, as mono samples at one rate."},
     input{"file", "WAV, AIFF, FLAC, Ogg, MP3, M4A, or a video file with sound"},
     param("rate_hz", &ReadAudioOptions::rate_hz, range{8000, 192000}, unit{"Hz"}, "Sample rate of the result"),
     param("required", &ReadAudioOptions::required,
           "Whether a video file without sound is an error; otherwise it gives no samples",
           inert{"changes only what happens to a file without sound"}),
     output("audio", &ReadAudioResult::audio, "The recording"),
     output("silent", &ReadAudioResult::silent, "True where there is nothing to hear"),
     output("source_rate_hz", &ReadAudioResult::source_rate_hz, "Sample rate of the file"),
     output("source_channels", &ReadAudioResult::source_channels, "Number of channels in the file"));
