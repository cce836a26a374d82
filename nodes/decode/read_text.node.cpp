// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_text.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.text", &read_text, version{1}, doc{"Reads a text as UTF-8 and trims it."},
     input{"file", "UTF-8, or UTF-16 with a byte order mark"}, output("text", "The text"));
