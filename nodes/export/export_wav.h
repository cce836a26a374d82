// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/audio.h"

namespace face::exports {

// Writes a recording as WAV: mono PCM of 16 bits at the recording's rate, to the nearest whole hertz; samples beyond
// full scale are clipped. Throws where a sample is not finite.
engine::File export_wav(const Audio& audio);

}  // namespace face::exports
