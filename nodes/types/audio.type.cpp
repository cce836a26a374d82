// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/audio.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Audio, "audio", codec_version{1}, doc{"A mono recording."}, field<&Audio::rate_hz>(), field<&Audio::samples>(),
     view{"wav", "export.wav"}, difference{"evaluate.audio_difference"});
