// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace face {

// The 52 blend shapes of Apple's ARKit (ARFaceAnchor.BlendShapeLocation), in the column order of Live Link Face.
inline constexpr std::array<std::string_view, 52> arkit_names = {"eyeBlinkLeft",
                                                                 "eyeLookDownLeft",
                                                                 "eyeLookInLeft",
                                                                 "eyeLookOutLeft",
                                                                 "eyeLookUpLeft",
                                                                 "eyeSquintLeft",
                                                                 "eyeWideLeft",
                                                                 "eyeBlinkRight",
                                                                 "eyeLookDownRight",
                                                                 "eyeLookInRight",
                                                                 "eyeLookOutRight",
                                                                 "eyeLookUpRight",
                                                                 "eyeSquintRight",
                                                                 "eyeWideRight",
                                                                 "jawForward",
                                                                 "jawRight",
                                                                 "jawLeft",
                                                                 "jawOpen",
                                                                 "mouthClose",
                                                                 "mouthFunnel",
                                                                 "mouthPucker",
                                                                 "mouthRight",
                                                                 "mouthLeft",
                                                                 "mouthSmileLeft",
                                                                 "mouthSmileRight",
                                                                 "mouthFrownLeft",
                                                                 "mouthFrownRight",
                                                                 "mouthDimpleLeft",
                                                                 "mouthDimpleRight",
                                                                 "mouthStretchLeft",
                                                                 "mouthStretchRight",
                                                                 "mouthRollLower",
                                                                 "mouthRollUpper",
                                                                 "mouthShrugLower",
                                                                 "mouthShrugUpper",
                                                                 "mouthPressLeft",
                                                                 "mouthPressRight",
                                                                 "mouthLowerDownLeft",
                                                                 "mouthLowerDownRight",
                                                                 "mouthUpperUpLeft",
                                                                 "mouthUpperUpRight",
                                                                 "browDownLeft",
                                                                 "browDownRight",
                                                                 "browInnerUp",
                                                                 "browOuterUpLeft",
                                                                 "browOuterUpRight",
                                                                 "cheekPuff",
                                                                 "cheekSquintLeft",
                                                                 "cheekSquintRight",
                                                                 "noseSneerLeft",
                                                                 "noseSneerRight",
                                                                 "tongueOut"};

inline constexpr std::size_t arkit_count = arkit_names.size();

// Index of a name in arkit_names, or arkit_count where it is not one of them.
constexpr std::size_t arkit_index(std::string_view name) {
  for (std::size_t i = 0; i < arkit_count; ++i)
    if (arkit_names[i] == name) return i;
  return arkit_count;
}

}  // namespace face
