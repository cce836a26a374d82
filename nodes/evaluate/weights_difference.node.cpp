// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/evaluate/number_differences.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.weights_difference", &weights_difference, version{1},
     doc{"How the blend-shape weights of one frame differ."}, input{"a", "Weights of a frame"}, input{"b", "Others"},
     output("table", "Rows all and every weight that differs: largest, rms, a, b"));
