// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/evaluate/number_differences.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.matrix_difference", &matrix_difference, version{1}, doc{"How two matrices of one size differ."},
     input{"a", "A matrix"}, input{"b", "Another"}, output("table", "largest, rms, row and column of the largest"));
