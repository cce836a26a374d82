// SPDX-License-Identifier: Apache-2.0
// What is told of the lips from a picture, in one step.
#pragma once
#include "nodes/track/inner_lips.h"
#include "nodes/track/lip_colours.h"
#include "nodes/track/mouth_opening.h"

namespace test {

inline face::Landmarks inner_lips_in(const face::Image& image, const face::Landmarks& landmarks,
                                     const face::Landmarks* rest = nullptr, const face::Matrix* depths_px = nullptr,
                                     const face::Matrix* head = nullptr,
                                     const face::track::InnerLipsOptions& options = {}) {
  const auto seen = face::track::lip_colours(image, landmarks);
  return face::track::inner_lips(seen.colours, seen.contrast, landmarks, rest, depths_px, head, options);
}

inline double mouth_opening_in(const face::Image& image, const face::Landmarks& landmarks) {
  return face::track::mouth_opening(face::track::lip_colours(image, landmarks).colours, landmarks);
}

}  // namespace test
