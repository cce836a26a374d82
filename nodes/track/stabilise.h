// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/landmarks.h"

namespace face::track {

struct StabiliseOptions {
  std::vector<std::string> rigid = {"eye_inner_r", "eye_inner_l", "nose_tip"};  // points that the jaw does not move
  double smooth_frames =
      1;  // standard deviation of the frames that the head's place is taken from; 0 = the frame alone
};

// The points of the window's middle frame with the head's motion taken out: moved, turned and scaled as the rigid
// points lie nearest to those of `rest` (least squares; similarity in the plane, closed form; Umeyama, Least-squares
// estimation of transformation parameters between two point patterns, 1991). The head's place is found from the rigid
// points of the neighbouring frames too, by a bell of `smooth_frames`: three points alone tremble, and what is below
// them trembles more. Rigid points come out where rest has them. Two points that can be seen give the turn and the
// scale as well, one gives the place alone; without any, all points of the frame are not valid, where they were.
// rest: the points that the face is laid upon; all rigid points are there.
Landmarks stabilise(const engine::Window<Landmarks>& landmarks, const Landmarks& rest,
                    const StabiliseOptions& options = {});

}  // namespace face::track
