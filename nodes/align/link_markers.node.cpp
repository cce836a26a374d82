// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/align/find_markers.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.link_markers", &link_markers, version{1},
     doc{"Names the markers of a take as those of a reference constellation."}, input{"markers", "A take's markers"},
     input{"reference", "The constellation whose names are taken"},
     param("tolerance_px", &LinkMarkersOptions::tolerance_px, range{0.1, 1000.0}, unit{"px"},
           "How far partners may be apart once the layouts lie on each other"),
     output("linked", "The markers that have a partner, under its name"));
