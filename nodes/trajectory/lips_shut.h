// SPDX-License-Identifier: Apache-2.0
// How P, B and M shut the lips of their neighbours. Internal to the area.
#pragma once
#include <string>

#include "nodes/types/phones.h"

namespace face::trajectory {

// A closure of a stop, a stop that was not split, or M.
bool is_bilabial_closure(const std::string& label);

// How far a closure has the lips at this time, 0 (not at all) to 1 (shut, while it lasts). Lips are as fast in one
// sentence as in another, so that they begin to shut closing_s before the closure and have parted as long after it,
// whatever the phones there want (as a smooth step, t^2 (3 - 2 t)). closing_s = 0: 0 outside of closures.
double lips_shut(const Phones& phones, double time_s, double closing_s);

}  // namespace face::trajectory
