// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/reopen.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mask;

NODE("mask.reopen", &reopen, version{1}, cheap{}, doc{"Takes the depth of a scan out where an image is white."},
     input{"scan", "The scan"}, input{"interior", "White where depth goes, from mask.remove_mouth"},
     output("opened", "The scan without it"));
