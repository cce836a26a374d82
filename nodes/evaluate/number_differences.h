// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/audio.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/matrix.h"
#include "nodes/types/table.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

// Every function here gives a table whose row "all" sums up and whose first column tells how far apart a and b are.

// Weights of one frame. Row "all": largest, rms (over all weights; what a shorter list lacks is 0), a and b empty; then
// a row for each that differs, by ARKit's name, or "shape N": largest, rms, a, b.
Table weights_difference(const Weights& a, const Weights& b);

// Tables: rows and columns are matched by name (rows of one name in their order). Columns: largest, then the columns
// that both have; row "all": the largest absolute difference of each; then b - a for every row that both have and that
// differs. only_in_a, only_in_b: counts of rows and columns, in row "all". Cells that are NaN in both are equal; NaN in
// one is infinitely far.
Table table_difference(const Table& a, const Table& b);

// Matrices of one size: largest, rms, row and column of the largest. Of unequal sizes: all NaN.
Table matrix_difference(const Matrix& a, const Matrix& b);

// Recordings: rms, largest (over what both last), level_db of the difference against a, and seconds that b is longer.
// Of unequal rates rms, largest and level_db are NaN.
Table audio_difference(const Audio& a, const Audio& b);

// Flows of one size, where both know the displacement: mean_px, p95_px, largest_px of the distances of its ends;
// only_in_a, only_in_b: pixels that one alone knows. Of unequal sizes: all NaN.
Table flow_difference(const FlowField& a, const FlowField& b);

}  // namespace face::evaluate
