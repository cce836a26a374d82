// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"

namespace face::weights {

// Throws where shapes do not fit or a number is not finite. basis: M x K, targets: N x M, neutral: M numbers or null.
void check_problem(const Matrix& basis, const Matrix& targets, const Matrix* neutral);

// Every column minus neutral (M numbers, a row or a column).
Matrix relative_basis(const Matrix& basis, const Matrix& neutral);

// Every row minus neutral.
Matrix relative_targets(const Matrix& targets, const Matrix& neutral);

}  // namespace face::weights
