// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/timeline.h"

namespace face::decode {

struct ReadVideoResult {
  Timeline timeline;   // of the frames, from the start of the file
  double rate_hz = 0;  // mean frame rate
};

// Reads the pictures of a video file in display order, as 8-bit sRGB; the id of a frame is its number from 0. The file
// is read once from its beginning: seeking in MPEG-1 returns wrong frames. Pictures are turned upright where the file
// says so; pixels keep the shape that they are stored in. Throws, naming the file, where it has no pictures or they
// cannot be decoded.
ReadVideoResult read_video(const engine::File& file, engine::SeqWriter<Image>& frames, engine::Progress& progress);

}  // namespace face::decode
