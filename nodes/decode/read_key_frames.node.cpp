// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_key_frames.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/timeline.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.key_frames", &read_key_frames, version{1}, cheap{},
     doc{"Reads the few frames of a video file that key shapes are of, without decoding all others again."},
     input{"file", "The file that decode.video has read"}, input{"timeline", "When each of its frames is shown"},
     input{"key_shapes", "The shapes, from cluster.key_shapes"},
     output("frames", "Their frames, as of decode.video and by the same ids"));
