// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/transfer/resample.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.scan_places", &scan_places, version{1},
     doc{"Where every vertex of a scanned mesh truly is on the head that was scanned."},
     input{"truth", "The point of the head that every pixel of the reference shows"},
     input{"mesh", "From model.scan_mesh on the reference"},
     input{"head", "The head: what is behind its lips does not count; unconnected: all counts"},
     output("places", "Triangle and weights of every vertex"));
