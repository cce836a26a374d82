// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/phantom/laser_truth.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.laser_landmarks", &laser_landmarks, version{1},
     doc{"Where a rig's 68 landmarks are in the picture of a laser scan: what a user would mark on it."},
     input{"rig", "The scanned head"}, input{"weights", "The scanned face"}, input{"scan", "The scan"},
     output("landmarks", "Points 00 to 67, Multi-PIE's order"));
