// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/matrix.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/table.h"

namespace face::model {

struct SpaceComparison {
  std::vector<double> angles_deg;  // principal angles of both spans, ascending; the last is "the" angle
  double residual_ratio = 0;       // variance of the examples that the basis does not explain, over all of it
};

// How much of the examples' span lies in the basis's (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and
// Video, 2003, section 2.6). examples: m x D, relative to their average; basis: p x D, need not be orthogonal. Angles
// by the singular values of Q_E^T Q_P (Bjorck and Golub, Numerical Methods for Computing Angles between Linear
// Subspaces, 1973); below 45 degrees by the sines, which are exact there. Differs from the paper: which angle it means
// is not said; the largest one is ours, and the residuals are those of an orthogonal projection whatever the basis.
SpaceComparison compare(const Matrix& examples, const Matrix& basis);

// A model's expressions against its identities, and its odd identity components against the even ones as a control.
// Rows "expression" and "control"; columns angle_deg (largest), smallest_angle_deg, residual_ratio.
Table compare_spaces(const MorphableModel& model);

}  // namespace face::model
