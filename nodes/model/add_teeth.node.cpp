// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/add_teeth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE(
    "model.add_teeth", &add_teeth, version{2},
    doc{"Adds teeth, cut out of two scans, and the inside of the mouth to a reference surface: upper teeth stay in the "
        "skull, lower ones follow the chin."},
    input{"surface", "The reference surface (model.scan_template)"},
    input{"scans", "Scans, two of which show the teeth"}, input{"shapes", "The skin in each (model.match_cylinder)"},
    param("upper", &AddTeethOptions::upper, "Id of the scan that shows the upper teeth; empty = the first"),
    param("lower", &AddTeethOptions::lower, "Id of the scan that shows the lower teeth; empty = the first"),
    param("least_brightness", &AddTeethOptions::least_brightness, range{0.0, 1.0}, unit{"1"},
          "Of a tooth, as a share of the brightest between the lips"),
    param("least_whiteness", &AddTeethOptions::least_whiteness, range{0.0, 1.0}, unit{"1"},
          "Of a tooth: blue over red"),
    output("surface", "With parts upper_teeth, lower_teeth and mouth_socket"));
