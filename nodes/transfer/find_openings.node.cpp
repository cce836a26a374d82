// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/find_openings.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.find_openings", &find_openings, version{2},
     doc{"Openings of a reference scan that lids shut, found by what a stream hides."},
     input{"mesh", "Of the reference scan, from model.scan_mesh"}, input{"reference", "The reference scan"},
     input{"shapes", "Where the vertices are in every frame, from model.sample_scan"},
     input{"frames", "The frames' scans, aligned with the reference"},
     param("least_area", &FindOpeningsOptions::least_area, range{0.0, 1.0}, unit{"1"},
           "Triangles that keep less of their area in the reference are hidden"),
     param("fewest_frames", &FindOpeningsOptions::fewest_frames, range{1, 1000000}, unit{"1"},
           "So many frames hide what is an opening"),
     output("openings", "Their outlines in the reference's picture; the points of opening 1 are 1.0, 1.1, ..."));
