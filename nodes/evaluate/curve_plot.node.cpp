// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/curve_plot.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.curve_plot", &curve_plot, version{1},
     doc{"Curves over time with phones and words underneath; those of one unit share a panel."},
     input{"curves", "A row per frame; every column is a curve"}, input{"more", "Further curves of the same frames"},
     input{"timeline", "When every frame is shown"}, input{"phones", "What is said when"},
     param("width_px", &CurvePlotOptions::width_px, range{200, 20000}, unit{"px"}, "Width of the picture"),
     param("panel_px", &CurvePlotOptions::panel_px, range{40, 2000}, unit{"px"}, "Height of one panel"),
     param("start_s", &CurvePlotOptions::start_s, range{0, 100000}, unit{"s"}, "Where the picture begins"),
     param("end_s", &CurvePlotOptions::end_s, range{0, 100000}, unit{"s"}, "Where it ends; 0 = with the timeline"),
     output("image", "The picture"));
