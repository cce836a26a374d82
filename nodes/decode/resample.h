// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

namespace face::decode {

// A mono recording at another rate, by libswresample's windowed-sinc polyphase filter. Keeps time: sample i of the
// result is at i / to_hz of the source. Its length is round(N * to_hz / from_hz).
std::vector<float> resample(const std::vector<float>& samples, double from_hz, double to_hz);

}  // namespace face::decode
