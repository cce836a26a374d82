// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/transfer/resample.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.resample_scan", &resample_scan, version{1},
     doc{"A new person's laser scan in the topology of the speaking model: a fitted model of identities gives the "
         "correspondence, the scan shape and colour."},
     input{"places", "From transfer.look_up"}, input{"head", "Whose mesh the identity model's is"},
     input{"fitted", "The identity model, fitted to the scan"}, input{"scan", "The laser scan"},
     input{"scan_from_model", "Motion of the identity model in the scan's fit; unconnected: none"},
     input{"world_from_model", "Its motion in the speaking model's fit; unconnected: none"},
     input{"mesh", "The speaking model's mesh"}, input{"shape", "Its vertices in the neutral frame"},
     output("shape", &ResampleScanResult::shape, "The person's points"),
     output("mesh", &ResampleScanResult::mesh, "The same as a mesh, in the scan's colours"));
