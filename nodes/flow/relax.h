// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/flow/plane.h"

namespace face::flow {

// A quadratic energy of a displacement field w:
//   sum_p w_p' [aa ab; ab bb]_p w_p - 2 (ra, rb)_p . w_p + sum over neighbours link_pq |w_p - w_q|^2.
// right: the link of a pixel to the one on its right, down: to the one below (the last column and row are not read).
struct FlowEnergy {
  Plane aa, ab, bb;
  Plane ra, rb;
  Plane right, down;
};

// Lowers the energy from a start by sweeps of successive over-relaxation, red pixels before black ones (Young,
// Iterative Solution of Large Linear Systems, 1971), and stays within rows first_row to last_row and columns
// first_column to last_column. over_relaxation: 1 to below 2.
struct RelaxArea {
  int first_row = 0, last_row = -1, first_column = 0, last_column = -1;
};
void relax(const FlowEnergy& energy, const RelaxArea& area, int sweeps, float over_relaxation, Plane& u, Plane& v);

}  // namespace face::flow
