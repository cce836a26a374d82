// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/upper_difference.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"
#include "nodes/base/sample_image.h"

namespace face::align {
namespace {

constexpr double upper_share = 0.6;  // of the markers, as orient has it: the jaw does not move them
constexpr int step_px = 2;           // lids and irises are larger

struct Pair {
  Eigen::Vector2d a, b;
};

double grey_at(const Image& picture, double x, double y) {
  float v[4];
  sample_image(picture, x, y, v);
  return grey_value<double>(v, picture.channels);
}

// The upper markers that both see, by name.
std::vector<Pair> pairs_of(const Landmarks& a, const Landmarks& b) {
  std::vector<Pair> pairs;
  for (const Landmark& p : a.points) {
    if (!p.valid) continue;
    const auto q =
        std::find_if(b.points.begin(), b.points.end(), [&](const Landmark& o) { return o.valid && o.name == p.name; });
    if (q != b.points.end()) pairs.push_back({{p.x_px, p.y_px}, {q->x_px, q->y_px}});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.a[1] < q.a[1]; });
  pairs.resize(static_cast<std::size_t>(std::ceil(upper_share * static_cast<double>(pairs.size()))));
  return pairs;
}

}  // namespace

double upper_difference(const Image& a, const Landmarks& a_markers, const Image& b, const Landmarks& b_markers) {
  check(a.width == b.width && a.height == b.height, "a is ", a.width, " x ", a.height, " pixels, b ", b.width, " x ",
        b.height);
  const std::vector<Pair> pairs = pairs_of(a_markers, b_markers);
  if (pairs.size() < 3 || a.pixels.empty()) return 0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> sides = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Vector2d low = pairs[0].a, high = pairs[0].a;
  for (const Pair& p : pairs) {
    const Eigen::Vector3d terms(1, p.a[0] - pairs[0].a[0], p.a[1] - pairs[0].a[1]);
    normal += terms * terms.transpose();
    sides += terms * p.b.transpose();
    low = low.cwiseMin(p.a);
    high = high.cwiseMax(p.a);
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (solver.vectorD().minCoeff() < 1e-6 * solver.vectorD().maxCoeff()) return 0;
  const Eigen::Matrix<double, 3, 2> motion = solver.solve(sides);
  double squares = 0, count = 0;
  for (int y = std::max(0, static_cast<int>(low[1])); y <= std::min(a.height - 1, static_cast<int>(high[1]));
       y += step_px)
    for (int x = std::max(0, static_cast<int>(low[0])); x <= std::min(a.width - 1, static_cast<int>(high[0]));
         x += step_px) {
      const Eigen::Vector2d to = (Eigen::RowVector3d(1, x - pairs[0].a[0], y - pairs[0].a[1]) * motion).transpose();
      const double difference = grey_at(a, x, y) - grey_at(b, to[0], to[1]);
      squares += difference * difference;
      ++count;
    }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace face::align
