// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/matrix.h"

namespace face::decode {

// Reads an array of numbers as NumPy saves it (NumPy Enhancement Proposal 1, A Simple File Format for NumPy Arrays;
// versions 1 to 3): float32, float64, int32, uint32, int64, uint8 or bool, little endian, in C or Fortran order.
// A number becomes 1 x 1, a list of N a column N x 1, an array of more than two dimensions its first one x the rest.
// Throws, naming the file and the byte, where it is something else, is cut off or goes on after its end, and where an
// int64 is too large for a double.
Matrix npy(const engine::File& file);

}  // namespace face::decode
