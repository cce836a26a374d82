// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

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
// them trembles more; neighbours count as far as they lie about this frame, which those of a shaking camera do not.
// Rigid points come out where rest has them. Two points that can be seen give the turn and the
// scale as well, one gives the place alone; without any, all points of the frame are not valid, where they were.
//
// Where a blink or a look down hides corners of the eyes, they are taken to go with the points that are seen all the
// while, evenly from where they were before to where they are after (up to 30 frames away; one side is enough): in so
// short a time a head hardly turns, but one point says nothing of how it is turned. Of the corners in these frames none
// is believed: lids carry them along for a while.
// rest: the points that the face is laid upon; all rigid points are there.
//
// A similarity takes a nod, which shortens the nose, for a step back, and drops the mouth by millimetres. With depths
// (N x 1: how far rest's points are towards the viewer, px; null = none) and two or more rigid points seen, the head
// is a solid that is seen by a camera far away instead (solid_head.h): its three angles, scale and
// place are those at which the rigid points lie nearest to where they were seen, turns and nods within 8 degrees or so
// and scales within a twentieth being likelier than others (Gauss-Newton). What a point has moved by itself is then in
// the plane of the picture at rest, at the depth that it had there.
//
// Three points are few: where the head turns by more than some degrees, they turn it too little and drop the mouth.
// head (7 x 1; null = not known): its pose since `rest` by all that is seen of it, and how like it is to what was
// there, 0 to 1 (track_klt.h). Where it is seen, poses near it are likelier too: turns and tilts within a degree
// or so, nods within 2 and scales within 3 %, as raised brows look like these; scales that differ by less than 2 % from
// that of `rest` are likelier still, and the points of all frames count as much as those of one. With it one rigid
// point is enough. It counts for nothing without depths.
Landmarks stabilise(const engine::Window<Landmarks>& landmarks, const Landmarks& rest, const Matrix* depths_px,
                    const Matrix* head, const StabiliseOptions& options = {});

}  // namespace face::track
