// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/mark_points.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.mark_points", &mark_points, version{1},
     doc{"Points as a hand places them: some of the exact ones that are seen, each a little off."},
     input{"exact", "The exact points, of phantom.truth_landmarks"},
     input{"id", "The picture's id (seq.ids), where one node marks many"},
     param("names", &MarkPointsOptions::names, "Which are marked"),
     param("error_px", &MarkPointsOptions::error_px, range{0.0, 100.0}, unit{"px"},
           "Standard deviation of a mark's x and y"),
     param("seed", &MarkPointsOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is another hand"),
     output("landmarks", "The marked points"));
