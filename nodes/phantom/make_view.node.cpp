// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_view.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.make_view", &make_view, version{1},
     doc{"A picture of a person as somebody might take it, drawn by lot: turn of the head, camera, light, mouth."},
     input{"rig", "The person"}, input{"id", "The picture's id (seq.ids), where one node makes many"},
     param("width_px", &MakeViewOptions::width_px, range{1, 4096}, unit{"px"}, "Width of the picture"),
     param("height_px", &MakeViewOptions::height_px, range{1, 4096}, unit{"px"}, "Height of the picture"),
     param("turn_deg", &MakeViewOptions::turn_deg, range{0.0, 180.0}, unit{"deg"},
           "The head is turned by up to this to either side"),
     param("nod_deg", &MakeViewOptions::nod_deg, range{0.0, 90.0}, unit{"deg"}, "It looks up or down by up to this"),
     param("nearest_mm", &MakeViewOptions::nearest_mm, range{200.0, 100000.0}, unit{"mm"},
           "Distance of the camera, at least"),
     param("farthest_mm", &MakeViewOptions::farthest_mm, range{200.0, 100000.0}, unit{"mm"},
           "At most; the lens makes faces about as large from anywhere"),
     param("light_turn_deg", &MakeViewOptions::light_turn_deg, range{0.0, 180.0}, unit{"deg"},
           "The light comes from up to this to either side"),
     param("open_share", &MakeViewOptions::open_share, range{0.0, 1.0}, unit{"1"}, "Share of open mouths"),
     param("seed", &MakeViewOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is another lot"),
     output("world_from_head", &MakeViewResult::world_from_head, "Where the head is"),
     output("camera", &MakeViewResult::camera, "Where it is seen from"),
     output("lighting", &MakeViewResult::lighting, "The light"),
     output("weights", &MakeViewResult::weights, "Of the rig's shapes: a mouth that is shut or open"));
