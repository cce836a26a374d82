// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/gaussian_path.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;

NODE("trajectory.gaussian_path", &gaussian_path, version{1},
     doc{"The smoothest path through one Gaussian per frame and dimension."}, input{"means", "T x K"},
     input{"variances", "T x K, more than 0"},
     param("smoothness", &GaussianPathOptions::smoothness, range{0, 1e12}, unit{"1"},
           "How much a change from frame to frame costs (lambda of the paper)"),
     output("path", "T x K"));
