// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.write_text", &toy::write_text, version{1}, doc{"Writes a text file."}, input{"text", "A text"},
     output("file", "A .txt file"));
