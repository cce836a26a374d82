// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/list_takes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.list_takes", &list_takes, version{3},
     doc{"The takes of a recorded stream of scans, with the sound and the text of each."},
     input{"folder", "A folder with files like depth/TAKE/17.png"},
     input{"sound", "A folder with a recording of every take; a take without one, or one that cannot be read, is left out"},
     input{"texts", "A folder with a .txt of every take; a take without one, or one that cannot be read, is left out"},
     output("takes", "Names of the takes"), output("sounds", "Their recordings"), output("scripts", "Their texts"),
     output("report", &ListTakesResult::report, "What was left out, a line each"));
