// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::decode {

struct ReadLandmarksResult {
  Landmarks landmarks;              // in the file's order
  std::int64_t image_width_px = 0;  // of the image they were placed on; 0 where neither file nor image says it
  std::int64_t image_height_px = 0;
};

enum class LandmarkNames { file, multi_pie, clip };

struct ReadLandmarksOptions {
  // file: as they stand there. multi_pie: MediaPipe's become Multi-PIE's 68, others stay; numbers have two digits.
  // clip: MediaPipe's and Multi-PIE's become the 18 that a clip is tracked by (nodes/base/clip_points.h), others stay;
  // right and left have to be where an upright face has them.
  LandmarkNames names = LandmarkNames::file;
  int frame = -1;  // of the clip, that the points have to be of where the file says one; -1: any
};

// Reads points placed on an image, told by what the file holds:
//   our JSON     {"image_size": [width, height], "points": {"name": [x, y], ...}}, in pixels, (0, 0) the centre of the
//                top left one
//   MediaPipe    a list of {"x": ..., "y": ...} (468 or 478 points; of several faces the first), by itself or as a
//                member named face_landmarks, faceLandmarks, multi_face_landmarks or landmarks; x and y are shares of
//                the image's width and height, which `image` gives, or "image_size" in the file. Names: "0", "1", ...
//   .pts         "n_points: 68" and a block of x y in braces, as the 300-W annotations: pixels that count from 1
//                (Sagonas et al., 300 Faces in-the-Wild Challenge, ICCVW 2013). Names: "0" to "67".
// image: the picture, or null. Where it is the file's picture in another size, the points are scaled to it. Throws
// where a point lies outside the image, and where the image is none of the file's at any size. Points of MediaPipe may
// lie outside: they are kept and not valid.
ReadLandmarksResult read_landmarks(const engine::File& file, const Image* image = nullptr,
                                   const ReadLandmarksOptions& options = {});

}  // namespace face::decode
