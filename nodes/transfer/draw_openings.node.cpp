// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/draw_openings.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.draw_openings", &draw_openings, version{3},
     doc{"Draws eyes before which lids move as layers: skin with a hole, and the eye behind it."},
     input{"drawn", "The reference's texture on the frame, from transfer.draw_texture"},
     input{"openings", "Outlines in the reference's picture, from transfer.find_openings"},
     input{"mesh", "Of the reference scan, from model.scan_mesh"},
     input{"reference", "The reference scan that the shape was learned with"},
     input{"texture", "The reference scan whose picture is drawn; unconnected: reference"},
     input{"shape", "Where the vertices are in the frame, from model.sample_scan"},
     input{"frame", "The frame's scan, aligned with the reference"},
     param("least_open", &DrawOpeningsOptions::least_open, range{0.0, 10.0}, unit{"1"},
           "Openings that keep less of their area are drawn as layers; 0 = none"),
     param("least_gain", &DrawOpeningsOptions::least_gain, range{0.0, 10.0}, unit{"1"},
           "Layers are kept where they leave less of the mesh's squared difference from the frame"),
     output("drawn", "The same with what is seen of eyes"));
