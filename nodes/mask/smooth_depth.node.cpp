// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/smooth_depth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mask;

NODE("mask.smooth_depth", &smooth_depth, version{1},
     doc{"Smooths the depth of a scan along its rows by passes of polynomials of falling degree."},
     input{"scan", "The scan"}, input{"where", "White pixels are smoothed; without it all"},
     param("smoothing", &SmoothDepthOptions::smoothing, {{"fits", Smoothing::fits}, {"kernels", Smoothing::kernels}},
           "Local polynomial fits, or convolution with (1 - u^2)^degree: both readings of the paper"),
     param("window_px", &SmoothDepthOptions::window_px, range{3, 1001}, unit{"px"}, "Length of the window, odd"),
     param("highest_degree", &SmoothDepthOptions::highest_degree, range{0, 30}, unit{"1"}, "Degree of the first pass"),
     param("lowest_degree", &SmoothDepthOptions::lowest_degree, range{0, 30}, unit{"1"}, "Degree of the last pass"),
     output("smoothed", "The smoothed scan"));
