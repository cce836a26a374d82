// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/check_rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.check_rig", &check_rig, version{5},
     doc{"Looks at a head before it is used: its shapes, size and mouth, and a file of names to fill in."},
     input{"file", "An OBJ folder, or a GLB or glTF file"},
     input{"names", "JSON object that maps the file's shape names to ARKit's, where they differ"},
     output("text", &CheckRigResult::text, "What was found, a finding per line"),
     output("sound", &CheckRigResult::sound, "Whether decode.rig takes it as it is"),
     output("names", &CheckRigResult::names,
            "names.json: every name that is none of ARKit's, with a proposal or empty"));
