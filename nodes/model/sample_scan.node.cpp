// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/sample_scan.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.sample_scan", &sample_scan, version{2},
     doc{"Shape and texture vector of a scan: sampled in correspondence with a reference."},
     input{"reference", "The reference scan, cropped"}, input{"target", "An aligned scan, holes filled"},
     input{"flow", "From the reference to the target"},
     param("stride_px", &ScanMeshOptions::stride_px, range{1, 100}, unit{"px"}, "Distance of the vertices"),
     output("shape", &SampleScanResult::shape, "Where the reference's vertices are"),
     output("texture", &SampleScanResult::texture, "Grey value of every vertex, in a row"),
     output("sampled", &SampleScanResult::sampled, "Share of the vertices that were measured"));
