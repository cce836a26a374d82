// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string_view>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::track {

// Which points a person is to place.
enum class PointLayout { lips18, lips12 };

struct AnnotateOptions {
  PointLayout points = PointLayout::lips18;
  std::int64_t first_frame = 0;    // of those that the page holds
  std::int64_t every = 1;          // 1 = each frame from there on, 5 = each fifth
  std::int64_t max_frames = 100;   // in the page
  std::int64_t jpeg_quality = 92;  // 1 to 100
};

// A page of its own, for any browser and without a network, on which a person places the layout's points on the first
// frame, and puts right what a tracker found on later ones. It saves what decode.landmarks and decode.corrections read.
// frames: the clip. tracks: where the points are, frame by frame, to be shown; null = none. corrections: made before,
// to be saved with the new ones; ids are frames; null = none. lips18: the inner corners of the eyes, the tip of the
// nose, 12 points on the outer edge of the lips, 3 on the jaw; lips12: the lips alone.
engine::File annotate(const engine::Seq<Image>& frames, const engine::Seq<Landmarks>* tracks,
                      const engine::Seq<Landmarks>* corrections, const AnnotateOptions& options = {});

// The page up to its data, and the rest.
std::string_view annotate_page_head();
std::string_view annotate_page_tail();

}  // namespace face::track
