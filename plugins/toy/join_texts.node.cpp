// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.join_texts", &toy::join_texts, version{1}, doc{"Joins a sequence of texts into a file."},
     input{"texts", "Texts"}, output("file", "A .txt file, a line break between the texts"));
