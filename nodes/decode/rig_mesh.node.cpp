// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/decode/read_mesh.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.rig_mesh", &rig_mesh, version{1}, doc{"The mesh of a head at rest."},
     input{"rig", "Head and its blend shapes"}, output("mesh", "Its mesh, without shapes"), cheap{});
