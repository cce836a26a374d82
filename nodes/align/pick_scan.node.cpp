// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/pick_scan.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.pick_scan", &pick_scan, version{1}, doc{"The scan with an id, from another recording of the same frames."},
     input{"scans", "All scans"}, input{"frame", "From align.choose_reference"},
     output("scan", "The one with that id"));
