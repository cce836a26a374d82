// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_text.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.text", &export_text, version{1}, doc{"Writes a text, as a node's report, as a file."},
     input{"text", "The text"}, output("file", "The .txt file"));
