// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace face {

// The 18 points that a clip is tracked by, and which of Multi-PIE's 68 each of them is.
struct ClipPoint {
  std::string_view name;
  std::size_t multi_pie;
};
inline constexpr std::array<ClipPoint, 18> clip_points = {{
    {"eye_inner_r", 39}, {"eye_inner_l", 42}, {"nose_tip", 30}, {"lip_0", 48}, {"lip_1", 49},  {"lip_2", 50},
    {"lip_3", 51},       {"lip_4", 52},       {"lip_5", 53},    {"lip_6", 54}, {"lip_7", 55},  {"lip_8", 56},
    {"lip_9", 57},       {"lip_10", 58},      {"lip_11", 59},   {"jaw_r", 7},  {"chin", 8},    {"jaw_l", 9},
}};

}  // namespace face
