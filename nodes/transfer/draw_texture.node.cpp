// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/draw_texture.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.draw_texture", &draw_texture, version{5}, doc{"The reference's texture on a frame, beside that frame."},
     input{"mesh", "Polygons, from model.scan_mesh"}, input{"reference", "The reference scan, whose picture is drawn"},
     input{"shape", "Where the vertices are in the frame, from model.sample_scan"},
     input{"frame", "The frame's scan, aligned with the reference"},
     input{"seen", "The same frame with the picture to compare with; unconnected: its own"},
     param("least_area", &DrawTextureOptions::least_area, range{0.0, 1.0}, unit{"1"},
           "Triangles that keep less of their area in the reference are hidden; 0 = none"),
     param("edge_px", &DrawTextureOptions::edge_px, range{0, 100}, unit{"px"},
           "So many pixels beside what is not drawn are left out of the mask: they see it, too; 0 = none"),
     output("drawn", &DrawTextureResult::drawn, "The reference's texture as the frame's camera sees it"),
     output("picture", &DrawTextureResult::picture, "The frame's own picture"),
     output("mask", &DrawTextureResult::mask, "White where the face is drawn, but for edges of edge_px"));
