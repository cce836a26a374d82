// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/remove_mouth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mask;

NODE("mask.remove_mouth", &remove_mouth, version{2},
     doc{"Takes teeth, tongue and the hollow of the mouth out of a scan, up to the inner edge of the lips, by one "
         "parameter. Give single frames another value by overrides; mask.review proposes them."},
     input{"scan", "The scan"}, input{"moved", "Landmarks of this frame: the rectangle moves with them"},
     input{"before", "The same where the rectangle was set"},
     param("threshold_mm", &RemoveMouthOptions::threshold_mm, range{0.01, 1000.0}, unit{"mm"},
           "How far behind the lips a surface has to lie to be inside the mouth"),
     param("centre_x", &RemoveMouthOptions::centre_x, range{0.0, 1.0}, unit{"1"},
           "Middle of the rectangle about the mouth, as a share of the picture's width"),
     param("centre_y", &RemoveMouthOptions::centre_y, range{0.0, 1.0}, unit{"1"}, "The same of its height"),
     param("width", &RemoveMouthOptions::width, range{0.01, 1.0}, unit{"1"},
           "Width of the rectangle as a share of the picture's: lips never leave it"),
     param("height", &RemoveMouthOptions::height, range{0.01, 1.0}, unit{"1"}, "Height, likewise"),
     output("scan", &RemoveMouthResult::scan, "The scan without depth inside the mouth"),
     output("interior", &RemoveMouthResult::interior, "White inside the mouth, else black"),
     output("report", &RemoveMouthResult::report, "One row: areas at this and other thresholds, for mask.review"));
