// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/perform_table.h"

namespace face::phantom {
namespace {

// Jaw: vowels by height (Ladefoged and Johnson, A Course in Phonetics, ch. 9); consonants by the order that Keating,
// Lindblom, Lubker and Kreiman measured (Variability in Jaw Height for Segments in English and Swedish VCVs, Journal of
// Phonetics, 1994): S, SH and T highest and least variable, then D, N, L, then K, and H free. Lips: rounded U, O, W, SH
// and R, spread I and E (Ladefoged and Johnson). Amounts and dominances were set by looking at the embedded head.
//                      jaw   pucker funnel spread upper lower tongue
constexpr Gestures kA = {0.46, 0.00, 0.06, 0.04, 0.16, 0.36, 0.00};
constexpr Gestures kO = {0.34, 0.24, 0.42, 0.00, 0.06, 0.20, 0.00};
constexpr Gestures kE = {0.31, 0.00, 0.00, 0.22, 0.16, 0.26, 0.00};
constexpr Gestures kI = {0.10, 0.00, 0.00, 0.48, 0.12, 0.22, 0.00};
constexpr Gestures kI2 = {0.16, 0.00, 0.00, 0.24, 0.10, 0.18, 0.00};
constexpr Gestures kU = {0.10, 0.74, 0.28, 0.00, 0.00, 0.04, 0.00};
constexpr Gestures kU2 = {0.16, 0.42, 0.26, 0.00, 0.02, 0.08, 0.00};
constexpr Gestures kOpenU = {0.30, 0.34, 0.38, 0.00, 0.04, 0.14, 0.00};
constexpr Gestures kHush = {0.05, 0.32, 0.50, 0.00, 0.16, 0.20, 0.00};
constexpr Gestures kTip = {0.08, 0.00, 0.00, 0.08, 0.06, 0.16, 0.00};
constexpr Gestures kBack = {0.19, 0.00, 0.00, 0.06, 0.08, 0.16, 0.00};
constexpr Gestures kHiss = {0.03, 0.00, 0.00, 0.22, 0.10, 0.24, 0.00};
constexpr Gestures kBetween = {0.15, 0.00, 0.00, 0.06, 0.10, 0.20, 0.30};
constexpr Gestures kShut = {0.06, 0.00, 0.00, 0.00, 0.00, 0.00, 0.00};
constexpr Gestures kLipTeeth = {0.06, 0.00, 0.00, 0.04, 0.20, 0.00, 0.00};

constexpr PhoneGesture kTable[] = {
    {"SIL", {}, 0.45, 0.45, 0.6},
    {"AA", kA, 1, 0.6, 0.5},
    {"AE", {0.41, 0, 0, 0.30, 0.20, 0.32, 0}, 1, 0.7, 0.5},
    {"AH", {0.28, 0, 0, 0.06, 0.12, 0.22, 0}, 0.8, 0.5, 0.5},
    {"AX", {0.18, 0, 0, 0.05, 0.08, 0.14, 0}, 0.5, 0.35, 0.4},
    {"AO", kO, 1, 0.9, 0.5},
    {"AW", kA, 1, 0.8, 0.5, PhoneContact::none, kU2},
    {"AY", kA, 1, 0.7, 0.5, PhoneContact::none, kI2},
    {"EH", kE, 0.9, 0.6, 0.5},
    {"ER", {0.17, 0.30, 0.34, 0, 0.08, 0.16, 0}, 0.7, 0.8, 0.5},
    {"EY", kE, 0.9, 0.8, 0.5, PhoneContact::none, kI},
    {"IH", kI2, 0.7, 0.6, 0.5},
    {"IY", kI, 0.8, 0.9, 0.5},
    {"OW", kOpenU, 0.9, 1, 0.5, PhoneContact::none, kU},
    {"OY", kO, 1, 0.9, 0.5, PhoneContact::none, kI2},
    {"UH", kU2, 0.7, 0.8, 0.5},
    {"UW", kU, 0.8, 1, 0.5},
    {"P", kShut, 0.6, 0.5, 0.4, PhoneContact::lips},
    {"B", kShut, 0.6, 0.5, 0.4, PhoneContact::lips},
    {"M", kShut, 0.6, 0.5, 0.4, PhoneContact::lips},
    {"F", kLipTeeth, 0.8, 0.8, 0.4, PhoneContact::teeth},
    {"V", kLipTeeth, 0.8, 0.8, 0.4, PhoneContact::teeth},
    {"TH", kBetween, 0.7, 0.4, 1.6},
    {"DH", kBetween, 0.6, 0.35, 1.4},
    {"T", kTip, 0.9, 0.25, 0.8},
    {"D", kTip, 0.8, 0.25, 0.8},
    {"N", {0.11, 0, 0, 0.06, 0.06, 0.16, 0}, 0.7, 0.25, 0.8},
    {"L", {0.16, 0, 0, 0.05, 0.08, 0.18, 0.08}, 0.6, 0.25, 1.0},
    {"S", kHiss, 1.5, 0.6, 0.9},
    {"Z", kHiss, 1.4, 0.6, 0.9},
    {"SH", kHush, 1.4, 1.1, 0.8},
    {"ZH", kHush, 1.3, 1.1, 0.8},
    {"CH", kHush, 1.3, 1.1, 0.8},
    {"JH", kHush, 1.3, 1.1, 0.8},
    {"K", kBack, 0.4, 0.15, 0.4},
    {"G", kBack, 0.4, 0.15, 0.4},
    {"NG", kBack, 0.4, 0.15, 0.4},
    {"HH", {0.22, 0, 0, 0, 0.08, 0.14, 0}, 0.15, 0.1, 0.2},
    {"R", {0.12, 0.32, 0.28, 0, 0.06, 0.12, 0}, 0.6, 0.8, 0.6},
    {"W", {0.08, 0.86, 0.22, 0, 0, 0, 0}, 0.7, 1.3, 0.4},
    {"Y", {0.09, 0, 0, 0.34, 0.08, 0.16, 0}, 0.7, 0.5, 0.6},
};

}  // namespace

const PhoneGesture* find_gesture(std::string_view label) {
  for (const PhoneGesture& gesture : kTable)
    if (gesture.label == label) return &gesture;
  return nullptr;
}

}  // namespace face::phantom
