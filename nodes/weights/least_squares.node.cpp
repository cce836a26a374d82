// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/least_squares.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::weights;

NODE("weights.least_squares", &least_squares, version{1},
     doc{"Weights of any sign that make every target from a few shapes with least squared error, for comparison."},
     input{"basis", "The shapes as columns, M x K"}, input{"targets", "The targets as rows, N x M"},
     input{"neutral", "M numbers that are subtracted from every shape and target"},
     param("sum_to_one", &LeastSquaresOptions::sum_to_one, "The weights of a target add up to one"),
     output("weights", &LeastSquaresResult::weights, "N x K"),
     output("rms", &LeastSquaresResult::rms, "Root mean square of what the weights do not explain"),
     output("full", &LeastSquaresResult::full, "False where the shapes depend on each other"));
