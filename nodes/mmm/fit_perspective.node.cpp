// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/fit_perspective.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.fit_perspective", &fit_perspective, version{1},
     doc{"The planar perspective of eight parameters that explains a flow, robustly."},
     input{"flow", "Displacements of a reference's pixels"}, input{"mask", "Dark pixels do not count"},
     param("outlier_px", &FitPerspectiveOptions::outlier_px, range{0.01, 100.0}, unit{"px"},
           "Residual whose weight is a quarter"),
     param("max_iterations", &FitPerspectiveOptions::max_iterations, range{1, 1000}, unit{"1"}, "Rounds at most",
           inert{"most fits need fewer"}),
     param("stride_px", &FitPerspectiveOptions::stride_px, range{1, 64}, unit{"px"}, "Every n-th pixel and row counts"),
     output("target_from_reference", &FitPerspectiveResult::target_from_reference, "3 x 3"),
     output("rms_px", &FitPerspectiveResult::rms_px, "Of the points within three outlier_px"),
     output("used", &FitPerspectiveResult::used, "How many these are"),
     output("solved", &FitPerspectiveResult::solved, "False where the points do not determine a perspective"));
