// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/depth_take.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.depth_take", &depth_take, version{4},
     doc{"Reads one take of a recorded stream of scans: depth pictures (PNG, EXR) or organised clouds (PLY, XYZ), "
         "pictures, masks and camera.json. What is wrong with a frame is named with its number; the rest is kept."},
     input{"folder", "A folder with camera.json, depth/TAKE/17.png and the like"},
     input{"take", "The take's name, from decode.list_takes"},
     param("near_mm", &DepthTakeOptions::near_mm, range{0.0, 1e6}, unit{"mm"}, "Least median depth of a frame"),
     param("far_mm", &DepthTakeOptions::far_mm, range{0.0, 1e6}, unit{"mm"}, "Largest median depth of a frame"),
     param("least_width_mm", &DepthTakeOptions::least_width_mm, range{0.0, 1e6}, unit{"mm"},
           "Least width of what a frame measures"),
     param("most_width_mm", &DepthTakeOptions::most_width_mm, range{0.0, 1e6}, unit{"mm"},
           "Largest width of what a frame measures"),
     param("face_change_mm", &DepthTakeOptions::face_change_mm, range{0.0, 1e6}, unit{"mm"},
           "A frame so far before or behind the others shows no face"),
     param("least_face", &DepthTakeOptions::least_face, range{0.0, 1.0}, unit{"1"},
           "A frame with a smaller share of the others' measured pixels shows no face"),
     output("scans", "The frames that are kept, by their numbers"),
     output("timeline", &DepthTakeResult::timeline, "When they were taken"),
     output("report", &DepthTakeResult::report, "What was wrong, a line each"),
     output("dropped", &DepthTakeResult::dropped, "How many frames were left out"),
     output("kept", &DepthTakeResult::kept, "False: no frame is left, leave the take's sound out (seq.where)"));
