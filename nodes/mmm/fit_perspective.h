// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"

namespace face::mmm {

struct FitPerspectiveOptions {
  double outlier_px = 0.5;  // residual whose weight is a quarter, once the fit is near
  std::int64_t max_iterations = 50;
  std::int64_t stride_px = 1;  // every n-th pixel and row counts
};

struct FitPerspectiveResult {
  Matrix target_from_reference;  // 3 x 3, last element 1; the identity where not solved
  double rms_px = 0;             // of the points within three outlier_px
  std::int64_t used = 0;         // how many these are
  bool solved = false;           // false with fewer than 8 points, or where they lie on a line
};

struct PointPair {
  double x_px, y_px;  // in the reference
  double to_x, to_y;  // in the target
};

// The eight parameters that map a plane's pixels in one view to those in another (Speech-Driven 3D Facial Animation,
// section 3.1): x' = (p1 x + p2 y + p3) / (p7 x + p8 y + 1), y' likewise with p4 to p6, by the equations made linear,
//   x' = p1 x + p2 y + p3 - p7 x x' - p8 y x'.
// Differs from the paper: coordinates are normalised (Hartley, In Defense of the Eight-Point Algorithm, PAMI 1997);
// each equation is divided by the last denominator, so that residuals are pixels; and points that do not move with the
// plane lose their weight (reweighted least squares, Geman and McClure's 1 / (1 + (r / s)^2)^2, with s falling from the
// residuals' own median to outlier_px).
FitPerspectiveResult fit_points(const std::vector<PointPair>& pairs, const FitPerspectiveOptions& options = {});

// The same for a flow. mask: of the flow's size; pixels below 128 do not count; null = all that are valid count.
FitPerspectiveResult fit_perspective(const FlowField& flow, const Image* mask,
                                     const FitPerspectiveOptions& options = {});

// Where a point goes. perspective: 3 x 3.
std::array<double, 2> map_point(const Matrix& perspective, double x_px, double y_px);

}  // namespace face::mmm
