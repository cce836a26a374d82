// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/scan_flow.h"

#include "engine/node.h"
#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.scan", &scan_flow, version{3},
     doc{"Dense correspondence of scans by radius and grey value together: the flow of Bergen and Hingorani with "
         "Blanz and Vetter's relaxation, as Bargmann, Blanz and Seidel use them."},
     input{"reference", "The scan whose pixels are followed"}, input{"target", "The scan they are found in"},
     input{"start", "Displacements to begin with: the head's motion, or markers"},
     param("levels", &ScanFlowOptions::levels, range{1, 10}, unit{"1"}, "Pyramid levels"),
     param("coarse_warps", &ScanFlowOptions::coarse_warps, range{1, 50}, unit{"1"},
           "Linearisations on every level but the finest"),
     param("fine_warps", &ScanFlowOptions::fine_warps, range{1, 50}, unit{"1"}, "Linearisations on the finest level"),
     param("window_px", &ScanFlowOptions::window_px, range{1, 31}, unit{"px"},
           "Side of the window whose pixels move alike, odd"),
     param("offset_window_px", &ScanFlowOptions::offset_window_px, range{0, 101}, unit{"px"},
           "Side of the window over which differences may have a mean (light, radius of a turned jaw); below 3 = none"),
     param("radius_weight", &ScanFlowOptions::radius_weight, range{0.0, 1000.0}, unit{"1"},
           "Weight of the channel radius; the others have 1"),
     param("smoothness", &ScanFlowOptions::smoothness, range{0.0, 1000.0}, unit{"1"},
           "How strongly neighbours are held together"),
     param("damping", &ScanFlowOptions::damping, range{0.0, 1000.0}, unit{"1"},
           "Smaller eigenvalue of the structure tensor below which a window is not believed"),
     param("tolerance", &ScanFlowOptions::tolerance, range{0.0, 1000.0}, unit{"1"},
           "Difference that counts half, in units of the channel's median gradient; 0 = all count fully"),
     param("bend_px", &ScanFlowOptions::bend_px, range{0.0, 1000.0}, unit{"px"},
           "Difference between neighbours' displacements at which they are held half; 0 = always fully"),
     param("search", &ScanFlowOptions::search, "Searches for patches on the coarser levels: large motions are found"),
     param("mismatch", &ScanFlowOptions::mismatch, range{0.0, 1000.0}, unit{"1"},
           "Difference of grey, in units of its median gradient, that says that a pixel is lost (a lid shuts over the "
           "eye) and is looked for again; 0 = it stays lost"),
     output("flow", "Displacement of every reference pixel"));
