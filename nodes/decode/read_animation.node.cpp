// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_animation.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.animation", &read_animation, version{1},
     doc{"Reads blend-shape weights over time: of a GLB or glTF file, or of a table of Live Link Face."},
     input{"file", "A GLB or glTF file with an animation of morph targets, or a .csv of Live Link Face"},
     input{"names", "JSON object that maps the file's shape names to ARKit's, where they differ"},
     param("timecode_rate_hz", &ReadAnimationOptions::timecode_rate_hz, range{1, 1000}, unit{"Hz"},
           "Frames per second of a table's timecodes"),
     output("weights", &ReadAnimationResult::weights, "Weights of every frame, in the order of decode.rig's shapes"),
     output("timeline", &ReadAnimationResult::timeline, "When each frame is shown"));
