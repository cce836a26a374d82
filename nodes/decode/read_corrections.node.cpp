// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_corrections.h"

#include "engine/node.h"
#include "nodes/types/landmarks.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.corrections", &read_corrections, version{1},
     doc{"Reads corrected points of a few frames; frames without corrections have no element."},
     input{"file", "JSON: [{\"frame\": 41, \"point\": \"lip_3\", \"xy\": [x, y]}]"},
     output("corrections", "The corrected points of each frame that has some"));
