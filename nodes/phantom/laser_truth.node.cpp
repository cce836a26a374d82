// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/laser_truth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.laser_truth", &laser_truth, version{1},
     doc{"Where the vertices of a surface that was cut from a laser scan truly are in another face."},
     input{"rig", "The other face's head, in the scanned one's topology"}, input{"weights", "The other face"},
     input{"truth", "Which point of the head every pixel of the scan shows (phantom.laser_scan)"},
     input{"surface", "The surface (model.scan_template)"}, output("points", "Its skin's vertices in the other face"));
