// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/list_takes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.list_takes", &list_takes, version{1}, doc{"The takes of a recorded stream of scans, by name."},
     input{"folder", "A folder with files like depth/TAKE/17.png"}, output("takes", "Names of the takes"));
