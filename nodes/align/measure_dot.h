// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"

namespace face::align {

struct Dot {
  double x_px = 0, y_px = 0;           // its middle
  double length_px = 0, width_px = 0;  // standard deviations of its area along its longer and shorter axis
};

// A dot that is lighter or darker than the skin about it, between pixels: the middle of its area, where a pixel counts
// by how far it is from the skin's grey to the dot's. The skin's is a plane fitted to the ring about the dot, from the
// ring's median and without what departs from it (hair, the next dot); what is compared are ratios to it, in which a
// dot on a side that falls into shade is as light at one end as at the other. grey: one channel. (x, y): a pixel
// within the dot. Without a dot the pixel itself, of no size.
Dot measure_dot(const Image& grey, int x, int y, double radius_px);

}  // namespace face::align
