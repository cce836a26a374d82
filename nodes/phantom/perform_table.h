// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>
#include <string_view>

namespace face::phantom {

// What the performer moves for speech, each from 0 to 1.
enum Gesture { kJaw, kPucker, kFunnel, kSpread, kUpperLip, kLowerLip, kTongue, kGestureCount };
using Gestures = std::array<double, kGestureCount>;

enum class PhoneContact { none, lips, teeth };

// What a phone asks for and how much it insists on it (the dominance of Cohen and Massaro).
struct PhoneGesture {
  std::string_view label;
  Gestures target = {};
  double jaw = 1, lips = 1, tongue = 1;  // dominance
  PhoneContact contact = PhoneContact::none;
  std::optional<Gestures> second = {};  // where a diphthong goes
};

// The gesture of a label without stress and without ".c" or ".r"; null where the table lacks it.
const PhoneGesture* find_gesture(std::string_view label);

}  // namespace face::phantom
