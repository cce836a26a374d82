// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/solve.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.solve", &solve, version{4},
     doc{"Finds the blend of example poses that takes some vertices where they have to be."},
     input{"space", "The examples, from meshik.prepare"}, input{"targets", "Where vertices have to be"},
     input{"start", "Weights to begin with"},
     param("max_iterations", &SolveOptions::max_iterations, range{1, 1000}, unit{"1"}, "Gauss-Newton steps at most",
           inert{"most frames need fewer"}),
     param("tolerance", &SolveOptions::tolerance, range{1e-12, 0.1}, unit{"1"},
           "Largest step of a weight that counts as none"),
     param("restraint", &SolveOptions::restraint, range{0, 1}, unit{"1"},
           "Energy of a weight of 1, per triangle: holds weights that the targets do not tell apart near 0"),
     param("give_mm2", &SolveOptions::give_mm2, range{0, 1e6}, unit{"1"},
           "Square of the mm by which a target is missed at the cost of energy 1; 0 = never"),
     output("weights", &SolveResult::weights, "One weight per example"),
     output("points", &SolveResult::points, "The vertices"),
     output("rms_gradient", &SolveResult::rms_gradient, "What the examples cannot explain of the vertices' gradients"),
     output("converged", &SolveResult::converged, "False where the steps did not become small"),
     output("iterations", &SolveResult::iterations, "Gauss-Newton steps"));
