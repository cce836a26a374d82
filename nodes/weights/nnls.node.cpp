// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/nnls.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::weights;

NODE("weights.nnls", &nnls, version{1},
     doc{"Weights >= 0 that make every target from a few shapes with least squared error."},
     input{"basis", "The shapes as columns, M x K"}, input{"targets", "The targets as rows, N x M"},
     input{"neutral", "M numbers that are subtracted from every shape and target"},
     param("sum_to_one", &NnlsOptions::sum_to_one, "The weights of a target add up to one"),
     output("weights", &NnlsResult::weights, "N x K"),
     output("kkt_residual", &NnlsResult::kkt_residual, "Largest relative violation of the optimality conditions"),
     output("rms", &NnlsResult::rms, "Root mean square of what the weights do not explain"));
