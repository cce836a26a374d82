// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/matrix.h"

namespace face::exports {

enum class NpyNumbers { real, integer };
enum class NpyShape {
  matrix,  // rows x columns
  vector,  // a list; the matrix is one column or one row
  points   // rows x columns / 3 x 3, or columns / 3 x 3 where there is one row
};

struct NpyOptions {
  NpyNumbers numbers = NpyNumbers::real;
  NpyShape shape = NpyShape::matrix;
};

// Writes a matrix as numpy.save does (NumPy Enhancement Proposal 1, version 1.0): float64 or int64, little endian, C
// order. Throws where a number is not whole and integers are asked for, and where the shape does not fit.
engine::File npy(const Matrix& matrix, const NpyOptions& options = {});

}  // namespace face::exports
