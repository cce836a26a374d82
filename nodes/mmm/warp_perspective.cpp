// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/warp_perspective.h"

#include <Eigen/Dense>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/sample_image.h"
#include "nodes/mmm/check_picture.h"
#include "nodes/mmm/fit_perspective.h"

namespace face::mmm {

Image warp_perspective(const Image& frame, const Matrix& perspective, const WarpPerspectiveOptions& options) {
  check_picture(frame, "frame");
  check(perspective.rows == 3 && perspective.columns == 3 && perspective.values.size() == 9, "perspective is ",
        perspective.rows, " x ", perspective.columns, ", expected 3 x 3");
  Eigen::Matrix3d h;
  for (int i = 0; i < 9; ++i) h(i / 3, i % 3) = perspective.values[static_cast<std::size_t>(i)];
  check(h.allFinite() && std::abs(h.determinant()) > 1e-12, "perspective has the determinant ", h.determinant(),
        ", expected one that can be inverted");
  if (options.inverse) h = h.inverse().eval();
  Matrix map{3, 3, {}};
  for (int i = 0; i < 9; ++i) map.values.push_back(h(i / 3, i % 3));
  Image steady{frame.width, frame.height, 3, {}};
  steady.pixels.reserve(frame.pixels.size());
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const auto [fx, fy] = map_point(map, x, y);
      float rgb[3] = {0, 0, 0};
      if (std::isfinite(fx) && std::isfinite(fy)) sample_image(frame, fx, fy, rgb);
      for (const float value : rgb) steady.pixels.push_back(to_byte(static_cast<double>(value)));
    }
  return steady;
}

}  // namespace face::mmm
