// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/find_markers.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.find_markers", &find_markers, version{2}, doc{"Finds painted dots on the first scan of a take."},
     input{"scans", "The take"},
     param("tone", &FindMarkersOptions::tone, {{"white", MarkerTone::white}, {"black", MarkerTone::black}},
           "Dots are lighter or darker than skin"),
     param("radius_px", &FindMarkersOptions::radius_px, range{1.0, 50.0}, unit{"px"}, "Radius of a dot"),
     param("least_contrast", &FindMarkersOptions::least_contrast, range{1.0, 255.0}, unit{"1"},
           "Grey levels by which a dot differs from the skin about it"),
     output("markers", "The dots, m0, m1, ... from the top"));
