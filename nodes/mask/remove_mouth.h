// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/table.h"

namespace face::mask {

// The rectangle is given in shares of the picture, so that it fits scans of every size.
struct RemoveMouthOptions {
  double threshold_mm = 6.5;
  double centre_x = 0.5;
  double centre_y = 0.68;
  double width = 0.24;
  double height = 0.27;
};

struct RemoveMouthResult {
  DepthScan scan;  // without depth inside the mouth
  Image interior;  // grey: 255 inside the mouth, else 0
  Table report;    // one row: what the proposal of another threshold is made from
};

// Takes teeth, tongue and the hollow of the mouth out of a scan, up to the inner edge of the lips, by one parameter
// (Bargmann, Blanz and Seidel, section 2: inner lip edges from depth and texture, inside a rectangle of constant size
// about the mouth, one parameter). In every column of the rectangle a band is stretched over the surface from lip to
// lip (the upper convex hull of the profile); what lies deeper below it than threshold_mm is inside, and so is what is
// not measured next to that. The edge is then moved by at most two pixels to the steepest step of grey, and the slit is
// followed into the corners of a mouth that is nearly shut by what is brighter than both lips and lies a little deeper.
// moved, before: landmarks of this frame and of the frame that the rectangle was set for; it moves with the median of
// their displacements. Without them it stays. Differs from the paper, which does not say how edges are detected.
// report: columns threshold_mm, area_px, area_low_px and area_high_px (the areas at 0.75 and 1.33 times the threshold),
// proposed_mm: the threshold in the middle of the range about which the area changes least.
RemoveMouthResult remove_mouth(const DepthScan& scan, const Landmarks* moved, const Landmarks* before,
                               const RemoveMouthOptions& options = {});

}  // namespace face::mask
