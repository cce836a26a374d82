// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/check_camera.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.check_camera", &check_camera, version{1},
     doc{"Whether a camera's focal lengths can be true: only in the right ones does a head that turns stay rigid."},
     input{"scans", "All scans"}, input{"markers", "Their markers"}, input{"reference", "The reference scan"},
     input{"reference_markers", "Its markers"},
     param("upper_share", &CheckCameraOptions::upper_share, range{0.01, 1.0}, unit{"1"},
           "Share of the markers, from the top, that are used"),
     param("frames", &CheckCameraOptions::frames, range{4, 10000}, unit{"1"}, "Frames that are looked at"),
     output("stretch_x", &CheckCameraResult::stretch_x, "Given fx by the one that fits best"),
     output("stretch_y", &CheckCameraResult::stretch_y, "The same of fy"),
     output("rms_mm", &CheckCameraResult::rms_mm, "How far markers are from a rigid head's"),
     output("best_rms_mm", &CheckCameraResult::best_rms_mm, "The same in the focal lengths that fit best"),
     output("told", &CheckCameraResult::told, "Whether the head turns enough to tell"),
     output("plausible", &CheckCameraResult::plausible, "False where it tells of other focal lengths"),
     output("report", &CheckCameraResult::report, "What was found, a line"));
