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
     input{"image", "The picture they were placed on, at any size: MediaPipe's files do not say it"},
     param("names", &ReadLandmarksOptions::names,
           {{"file", LandmarkNames::file}, {"multi_pie", LandmarkNames::multi_pie}, {"clip", LandmarkNames::clip}},
           "As in the file; or MediaPipe's as Multi-PIE's 68; or those two as the 18 that a clip is tracked by",
           inert{"points of a clip stay what they are"}),
     param("frame", &ReadLandmarksOptions::frame, range{-1, 1000000}, unit{"1"},
           "Of the clip, that the points have to be of where the file says one; -1 = any",
           inert{"it refuses, and changes nothing"}),
     output("landmarks", &ReadLandmarksResult::landmarks, "The points, in the file's order"),
     output("image_width_px", &ReadLandmarksResult::image_width_px, "Width of the image they were placed on"),
     output("image_height_px", &ReadLandmarksResult::image_height_px, "Height of the image they were placed on"));
