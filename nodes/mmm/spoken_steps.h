// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "nodes/types/phones.h"

namespace face::mmm {

// What pulls a spoken path at each of its steps. Frames of a film are too far apart for it: a closure of 50 ms is one
// of them or two, as chance will have it, so that a path is found at several steps per frame.
struct SpokenSteps {
  std::vector<std::size_t> phone;  // place in the phones
  std::vector<bool> held;          // where lips are shut: the path goes through the phone's mean
};

// time_s: of the steps, ascending. hold_closures: lips stay shut all through every M and closure of P and B, not
// shorter than 45 ms, which a film of 25 frames per second shows once; of a stop that is not split into closure and
// release the first three fifths are closure (69 of 113 ms of P; Byrd, 54,000 American Stops, UCLA Working Papers in
// Phonetics 83, 1993).
SpokenSteps spoken_steps(const Phones& phones, const std::vector<double>& time_s, bool hold_closures);

// The labels, with "SIL.edge" in place of "SIL" where speech begins and ends: lips come from rest there, while in a
// pause between words they hardly leave what is said.
std::vector<std::string> spoken_labels(const Phones& phones);

// How much stronger than all else held steps are: what is left of the error is far below a weight's last bit.
inline constexpr double held_pull = 1e9;

// Of the times of frames, `steps` for each: the last one's reach up to the end.
std::vector<double> step_times(const std::vector<double>& frame_s, double end_s, std::size_t steps);

}  // namespace face::mmm
