// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/report.h"

#include "engine/node.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/timeline.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.report", &report, version{2},
     doc{"Says in which frames of a track something is wrong: nothing to see, cuts, lost faces and points."},
     input{"landmarks", "The points of each frame"}, input{"state", "What track.klt says of each frame"},
     input{"timeline", "When every frame is shown"}, output("text", &ReportResult::text, "A line each"),
     output("file", &ReportResult::file, "The same, as a .txt file"));
