// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/orient.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.orient", &orient, version{2},
     doc{"Takes the head's motion out of a scan: absolute orientation by markers that the jaw does not move."},
     input{"scan", "The scan"}, input{"markers", "Its markers"}, input{"reference", "The reference scan"},
     input{"reference_markers", "Its markers"},
     param("rigid", &OrientOptions::rigid, "Names of the markers that the jaw does not move; empty = the upper ones"),
     param("upper_share", &OrientOptions::upper_share, range{0.01, 1.0}, unit{"1"},
           "Where none are named: share of the markers, from the top, that are used"),
     param("scale_mm", &OrientOptions::scale_mm, range{0.001, 1000.0}, unit{"mm"},
           "Distance at which a marker counts a quarter; more where half of them are farther off"),
     output("aligned", &OrientResult::aligned, "The scan in the reference's world"),
     output("reference_from_scan", &OrientResult::reference_from_scan, "The motion"),
     output("rms_mm", &OrientResult::rms_mm, "Distance of the markers that count, root mean square"),
     output("used", &OrientResult::used, "Markers that count"),
     output("solved", &OrientResult::solved,
            "False for fewer than three markers that agree; the scan then is where it was"));
