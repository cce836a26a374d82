// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_landmarks.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.landmarks", &read_landmarks, version{1}, doc{"Reads named points that were placed on an image."},
     input{"file",
           "JSON: {\"image_size\": [width, height], \"points\": {\"name\": [x, y]}}; MediaPipe's JSON; or .pts"},
     input{"image", "The picture they were placed on: MediaPipe's files do not say its size"},
     output("landmarks", &ReadLandmarksResult::landmarks, "The points, in the file's order"),
     output("image_width_px", &ReadLandmarksResult::image_width_px, "Width of the image they were placed on"),
     output("image_height_px", &ReadLandmarksResult::image_height_px, "Height of the image they were placed on"));
