// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <complex>
#include <vector>

namespace face {

// A point in the middle of a face: where it is seen, and where a usual head has it below and in front of the middle
// between the inner corners of the eyes, in their distance.
struct MiddleMark {
  std::complex<double> seen_px;
  double below = 0, depth = 0;
  // How far persons' points are from the usual place, and the point from the middle, standard deviations in the same
  // unit: across the face and along it.
  double across_error = 0, along_error = 0;
};
// After the variation of these distances among adults (Farkas, Anthropometry of the Head and Face, 1994: noses and
// upper faces differ by 7 %); a nose is in the middle of its face, mouths speak to one side, jaws hang.
MiddleMark nose_tip_mark(std::complex<double> seen_px, double below, double depth);
MiddleMark mouth_mark(std::complex<double> seen_px, double below, double depth);  // between its corners
MiddleMark chin_mark(std::complex<double> seen_px, double below, double depth);

// How a head is turned to a camera far away, in the picture's axes (x right, y down, z to the viewer): nodded, then
// turned, then tilted. Nobody looks straight into the camera on a given frame.
struct HeadFacing {
  double nod = 0, turn = 0;         // rad; the tilt is that of `unit_px`
  std::complex<double> middle_px;   // between the inner corners of the eyes
  std::complex<double> unit_px{1};  // from the right corner to the left one, if the head were not turned

  // How far a place of the picture lies towards the viewer, before the middle between the eyes, if the point of the
  // head that is seen there is so far in front of it when the head is seen from the front; px both.
  double depth_px(std::complex<double> seen_px, double front_depth_px) const;
};

// By the inner corners of the eyes (right_px: of the right eye, on the left of the picture) and points in the middle of
// the face, by as much as persons differ: what is in front goes aside when a head turns (least squares over turn and
// tilt; a turn is likely within 15 degrees), and down when it nods (over nod and length of the face; a nod is likely
// within 6 degrees, and a long nose looks like one, so that about half of it is believed). No marks: seen from the
// front.
HeadFacing head_facing(std::complex<double> right_px, std::complex<double> left_px,
                       const std::vector<MiddleMark>& marks);

}  // namespace face
