// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

struct TrackKltOptions {
  std::int64_t window_px = 15;     // side of the patch that is followed, odd; dots take less of it (telling_side_px)
  std::int64_t levels = 3;         // of the pyramid, above the image itself
  double stiffness = 0.5;          // of the springs between neighbours; 0 follows every point alone
  double max_return_error_px = 1;  // a point followed there and back must come home this close
  double max_offset_px = 2;    // from where its neighbours say that it is, in the direction in which it is seen well
  double min_likeness = 0.8;   // correlation with a point's own patch that counts as seeing it again
  double max_anchor_px = 1.5;  // how far a point may be moved to its own patch
  std::vector<std::string> rigid = {"eye_inner_r", "eye_inner_l", "nose_tip"};  // points that always look alike
  double search_px = 5;  // how far from where it should be a lost point is looked for
  // The outer edge of the lips in order, a corner of the mouth first and the other half way round; {} = no such edge.
  std::vector<std::string> outline = {"lip_0", "lip_1", "lip_2", "lip_3", "lip_4",  "lip_5",
                                      "lip_6", "lip_7", "lip_8", "lip_9", "lip_10", "lip_11"};
  // The contour of the chin from one side to the other; sought where the outline is and all of these are there.
  std::vector<std::string> jaw_line = {"jaw_r", "chin", "jaw_l"};
  double edge_reach_px = 4;  // how far from where it is expected the edge of the lips is looked for
  // Pictures with a narrower mouth than the first are made larger, with a wider one than the last smaller, until it is
  // as wide as the one between; all other lengths count in what is then a pixel.
  double smallest_mouth_px = 30, tracked_mouth_px = 50, largest_mouth_px = 100;
  double fine_detail = 0.045;  // pictures that would lose less of their contrast are made smaller, too
};

struct TrackKltResult {
  Landmarks landmarks;  // in the order of the start points
  Landmarks followed;   // the same as if nobody had put anything right
  Landmarks put_right;  // the points that corrections placed, in this or an earlier frame, where they are now; by name
  Landmarks layout;     // the start points with what corrections said: how the points lie to each other at rest
  Matrix look;          // what the edge of the lips looks like (outline.h); 0 x 0 without an outline
  Matrix coarse_look;   // the same in a smaller picture, where a wide mouth is looked for first; else 0 x 0
  Matrix jaw_look;      // what the contour of the chin looks like (jaw_line.h); 0 x 0 without one
  Image patches;        // grey; every point's patch at the start, and below where a correction placed it; side by side
  Image face;           // grey, small; what is looked for when everything was lost
  Image head_look;  // grey; what is between brows and nose at the start (head_motion.h); empty where that is unknown
  // The head's pose since the start, 7 x 1: nod, turn, tilt (rad), logarithm of the scale, where the middle between the
  // eyes is (x and y, px), and how alike the head is (1 = the same); 0 x 0 without head_look.
  Matrix head;
  Image face_colours;  // what light is told by at the start (light_change.h); empty where the head is not followed
  // What takes a level of this frame to one in the light of the start, 3 x 2: gain and offset of red, green and blue;
  // 0 x 0 without face_colours.
  Matrix light;
  Matrix confidence;  // points x 1; 0 = lost, 1 = looks as where it was placed
  std::string state;  // start, followed, found (again), cut (another picture than before), even (black, white), lost
  bool valid = true;  // at least a third of the points is seen
  double lost = 0;    // points that are not valid in this frame
  double return_error_px = 0;  // largest there-and-back error of the points that were kept
  double shrunk = 1;           // how many pixels of the picture are one of that in which points were followed
};

// Follows points from the previous frame to this one. frames: the previous frame and this one (window 1, 0). start: the
// points on the first frame. correction: points of this frame that somebody put right, by name; null where there are
// none. prior: this function's result for the previous frame. At the first frame the result is `start`.
//
// Each point goes by pyramidal KLT (flow_pair.h) and back: one that does not come home (Kalal, Mikolajczyk, Matas:
// Forward-Backward Error, ICPR 2010), or that leaves its neighbours, is looked for near where the others say that it
// is, by the patch that it had at the start. Differs from plain KLT: three rigid points carry the layout of all; points
// are kept together by springs and the shapes of a mouth (settle.h, mouth_shape.h); against drift a point whose own
// patch is seen again near its place goes there, and the points of the outline go to the edge of the lips (outline.h),
// those of the jaw line to the contour of the chin (jaw_line.h).
//
// Where all points are of the 18-point layout, the head is followed as a whole by what is seen between brows and nose
// (head_motion.h): its pose carries the layout, says where points are looked for, and holds rigid points whose own
// patches are not seen, from the side or under a lid. What is seen there tells light and camera, too: a frame in which
// they have changed is taken back to the light of the first before the edge of the lips is looked for. Where it is not
// seen, three rigid points are a pose of an average head (solid_head.h), and each of them is valid only while its own
// patch is seen: the corner of an eye would follow the closing lid otherwise.
//
// Patches and reaches are made for mouths of 30 to 90 px: a patch of 15 px in a close-up holds nothing that tells its
// place, in a small picture half the mouth. Where the mouth at the start is wider or narrower, all this happens in a
// smaller or larger picture; in a smaller one also where the picture is so soft that it shows nothing more.
//
// A point that is not valid goes with the others to where they say that it is, within the picture; where nothing is
// seen it keeps its place. Rigid points that are not seen go with those that are, so that a blink does not leave the
// turn of the head to the tip of the nose. A frame without contrast, after a cut, or in which neither the head nor a
// third of the points are seen is not valid, until the face is found again, as large and as upright as at the start. A
// head that suddenly looks otherwise than in the frame before is a cut, too, even where every point is seen in it:
// another speaker who sits alike. It is found again where it looks as at the start.
//
// A correction replaces a point from its frame to the next correction of the same point: it is followed from there,
// with the patch that it has there, between the other points as they are without corrections. So a correction changes
// no other point, and no frame from the same point's next correction on.
TrackKltResult track_klt(const engine::Window<Image>& frames, const Landmarks& start, const Landmarks* correction,
                         const engine::Prior<TrackKltResult>& prior, const TrackKltOptions& options = {});

}  // namespace face::track
