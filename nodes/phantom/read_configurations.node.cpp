// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/read_configurations.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.read_configurations", &read_configurations, version{1},
     doc{"Reads faces to make, such as the mouth configurations of a laser scan session, as weights by ARKit name."},
     input{"file", "JSON, such as graphs/phantom/mouth_configurations.json"},
     output("weights", "52 weights per face, under its name"));
