// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/types/image.h"

namespace face::track {

// A grey picture in floating point, rows from the top.
struct Grey {
  int width = 0;
  int height = 0;
  std::vector<float> values;  // height x width, 0 to 255

  // Bilinear; outside, the nearest pixel's.
  float at(double x, double y) const;
};

// Luma of an image (BT.601 weights; a grey image as it is).
Grey grey_of(const Image& image);

// Of a part of it that lies inside.
Grey grey_of(const Image& image, int left, int top, int width, int height);

// The square of side_px about a point, bilinear. side_px x side_px.
std::vector<float> cut_patch(const Grey& grey, double x_px, double y_px, int side_px);

// The middle of a square patch, side_px x side_px of it; both sides odd.
std::vector<float> middle_of(const std::vector<float>& patch, int patch_side_px, int side_px);

// The smallest odd side, from least_px on, of a square in the middle of a patch that tells its place in every direction
// as surely as a dot painted on skin does; the whole patch's where none does (Shi and Tomasi, Good Features to Track,
// CVPR 1994: the smaller eigenvalue of the mean outer product of gradients, grey values per px, squared). A large patch
// on a small dot holds much that moves by itself; a small one on skin holds nothing.
int telling_side_px(const std::vector<float>& patch, int patch_side_px, int least_px);

// Where a patch was found.
struct PatchMatch {
  double x_px = 0;
  double y_px = 0;
  double likeness = -1;  // zero-mean normalised cross-correlation, -1 to 1; 0 for a patch without contrast
  bool converged = false;
};

// Moves a patch over an image from a starting place until it fits best, to sub-pixel accuracy: inverse compositional
// Gauss-Newton on the translation, blind to gain and offset of brightness (Baker and Matthews, Lucas-Kanade 20 Years
// On, IJCV 2004, section 3.2; the patch is normalised as in its section 5 on gain and bias).
PatchMatch align_patch(const std::vector<float>& patch, int side_px, const Grey& grey, double x_px, double y_px);

// Looks for a patch at every pixel within radius_px of a place, then aligns it.
PatchMatch search_patch(const std::vector<float>& patch, int side_px, const Grey& grey, double x_px, double y_px,
                        double radius_px);

}  // namespace face::track
