// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_video.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/timeline.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.video", &read_video, version{2}, cheap{}, doc{"Reads the pictures of a video file, in display order."},
     input{"file", "MP4, MOV, MPEG, AVI, MKV, WebM"},
     output("frames", "The pictures, 8-bit sRGB; ids are frame numbers from 0"),
     output("timeline", &ReadVideoResult::timeline, "When each frame is shown"),
     output("rate_hz", &ReadVideoResult::rate_hz, "Mean frame rate"));
