// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_text_grid.h"

#include "engine/node.h"
#include "nodes/types/phones.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.text_grid", &export_text_grid, version{1},
     doc{"Writes an alignment as a TextGrid for Praat: words and phones."}, input{"phones", "The alignment"},
     output("file", "The .TextGrid file"));
