// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/track_markers.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.track_markers", &track_markers, version{6},
     doc{"Follows painted markers through a take of scans by template matching, to a fraction of a pixel."},
     input{"scan", "The scan"}, input{"start", "The markers on the take's first scan"},
     input{"correction", "Markers put right on this scan"},
     param("template_px", &TrackMarkersOptions::template_px, range{3, 101}, unit{"px"}, "Side of a marker's square"),
     param("search_px", &TrackMarkersOptions::search_px, range{2, 400}, unit{"px"},
           "Side of the neighbourhood in which it is looked for"),
     param("least_likeness", &TrackMarkersOptions::least_likeness, range{-1.0, 1.0}, unit{"1"},
           "Correlation below which a marker counts as lost"),
     output("markers", &TrackMarkersResult::markers, "The markers of this scan"),
     output("templates", &TrackMarkersResult::templates, "Their squares side by side"),
     output("moved_px", &TrackMarkersResult::moved_px, "How far each went since the scan before"),
     output("bends", &TrackMarkersResult::bends, "How its square lies against when it was taken"),
     output("report", &TrackMarkersResult::report, "Names of those that are lost here"));
