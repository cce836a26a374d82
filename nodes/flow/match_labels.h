// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/flow/plane.h"

namespace face::flow {

// Pixels of a picture, bounds included.
struct PixelBox {
  int left = 0, top = 0, right = -1, bottom = -1;
};

struct MatchLabelsOptions {
  std::vector<float> weights;  // per channel, of its squared difference
  std::vector<float> caps;     // per channel: the largest difference that counts
  int reach_x_px = 4;          // whole pixels about the field given
  int reach_y_px = 12;         // at most 14
  float step_cost = 1;         // neighbours a pixel apart; in caps and costs a difference times the weight's root
  float jump_cost = 12;        // neighbours further apart
};

// Where a box of a picture is seen in another: for every pixel the displacement, in whole pixels within a reach about
// the one given, that minimises the sum of differences, each up to a cap, and of what neighbours' displacements cost
// where they differ, a little for one pixel and the same for any more: jumps stay sharp. From eight directions
// (Hirschmueller, Stereo Processing by Semiglobal Matching and Mutual Information, PAMI 2008, eqs. 11 to 14; here
// displacements have two components). A place that is not measured, or outside, costs half of what counts at most.
// u, v: on return the displacement found, inside the box.
void match_labels(const Level& picture, const Level& other, const PixelBox& box, const MatchLabelsOptions& options,
                  Plane& u, Plane& v);

// What one pixel costs at a place of the other picture, as above, with the nearest pixel of that place.
float match_cost(const Level& picture, const Level& other, const MatchLabelsOptions& options, int x, int y, int other_x,
                 int other_y);

}  // namespace face::flow
