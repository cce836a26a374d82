// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/landmarks.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.landmarks", &landmarks, version{1},
     doc{"Tracked points beside the true ones: NME, failure rate, area under the curve, RMS in pixels, points lost."},
     input{"track", "Points of every frame"}, input{"truth", "The true points, by the same names"},
     param("left_corner", &LandmarksOptions::left_corner, "Name of the outer corner of one eye"),
     param("right_corner", &LandmarksOptions::right_corner, "Name of the outer corner of the other eye"),
     param("failed_percent", &LandmarksOptions::failed_percent, range{0.1, 100}, unit{"%"},
           "A frame with a larger NME is a failure"),
     output("table", &LandmarksResult::table, "The metrics over all frames"),
     output("frames", &LandmarksResult::frames, "NME, RMS and lost points per frame"));
