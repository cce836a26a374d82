// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/fit_perspective.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"

namespace face::mmm {
namespace {

using Eigen::Matrix3d;
using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Vector8d = Eigen::Matrix<double, 8, 1>;

Matrix as_matrix(const Matrix3d& h) {
  Matrix made{3, 3, {}};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) made.values.push_back(h(r, c));
  return made;
}

// Takes the middle to 0 and the mean distance from it to sqrt 2.
Matrix3d hartley(const std::vector<PointPair>& pairs, double PointPair::*x, double PointPair::*y) {
  double mx = 0, my = 0, distance = 0;
  for (const PointPair& p : pairs) mx += p.*x, my += p.*y;
  const auto n = static_cast<double>(pairs.size());
  mx /= n, my /= n;
  for (const PointPair& p : pairs) distance += std::hypot(p.*x - mx, p.*y - my);
  const double s = distance > 0 ? std::sqrt(2.0) * n / distance : 1;
  Matrix3d t;
  t << s, 0, -s * mx, 0, s, -s * my, 0, 0, 1;
  return t;
}

}  // namespace

std::array<double, 2> map_point(const Matrix& p, double x, double y) {
  const std::vector<double>& h = p.values;
  const double d = h[6] * x + h[7] * y + h[8];
  return {(h[0] * x + h[1] * y + h[2]) / d, (h[3] * x + h[4] * y + h[5]) / d};
}

FitPerspectiveResult fit_points(const std::vector<PointPair>& pairs, const FitPerspectiveOptions& options) {
  FitPerspectiveResult result;
  result.target_from_reference = as_matrix(Matrix3d::Identity());
  if (pairs.size() < 8) return result;
  const Matrix3d from = hartley(pairs, &PointPair::x_px, &PointPair::y_px);
  const Matrix3d to = hartley(pairs, &PointPair::to_x, &PointPair::to_y);
  const std::size_t n = pairs.size();
  std::vector<double> weight(n, 1), residual(n, 0);
  Vector8d p;
  p << 1, 0, 0, 0, 1, 0, 0, 0;
  Matrix3d h = Matrix3d::Identity();
  double scale_px = 0;
  for (std::int64_t round = 0; round < options.max_iterations; ++round) {
    Matrix8d normal = Matrix8d::Zero();
    Vector8d right = Vector8d::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      const double x = from(0, 0) * pairs[i].x_px + from(0, 2), y = from(1, 1) * pairs[i].y_px + from(1, 2);
      const double u = to(0, 0) * pairs[i].to_x + to(0, 2), v = to(1, 1) * pairs[i].to_y + to(1, 2);
      const double d = p[6] * x + p[7] * y + 1;
      const double w = weight[i] / std::max(d * d, 1e-6);
      Vector8d a, b;
      a << x, y, 1, 0, 0, 0, -x * u, -y * u;
      b << 0, 0, 0, x, y, 1, -x * v, -y * v;
      normal += w * (a * a.transpose() + b * b.transpose());
      right += w * (a * u + b * v);
    }
    const Eigen::SelfAdjointEigenSolver<Matrix8d> parts(normal);
    // Points on a line leave a direction undetermined; 1e-10 is far above rounding and far below what a plane of any
    // use leaves in normalised coordinates.
    if (!(parts.eigenvalues()[0] > 1e-10 * parts.eigenvalues()[7])) return result;
    const Vector8d next =
        parts.eigenvectors() * (parts.eigenvectors().transpose() * right).cwiseQuotient(parts.eigenvalues()).eval();
    const double step = (next - p).cwiseAbs().maxCoeff();
    p = next;
    Matrix3d normalised;
    normalised << p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], 1;
    h = to.inverse() * normalised * from;
    h /= h(2, 2);
    const Matrix made = as_matrix(h);
    for (std::size_t i = 0; i < n; ++i) {
      const auto [x, y] = map_point(made, pairs[i].x_px, pairs[i].y_px);
      residual[i] = std::hypot(x - pairs[i].to_x, y - pairs[i].to_y);
    }
    const double before_px = scale_px;
    scale_px = std::max(options.outlier_px, std::min(1.4826 * median(residual), round ? scale_px * 0.7 : 1e9));
    for (std::size_t i = 0; i < n; ++i) {
      const double r = residual[i] / scale_px;
      weight[i] = 1 / ((1 + r * r) * (1 + r * r));
    }
    if (round > 2 && step < 1e-10 && scale_px == before_px) break;
  }
  double squares = 0;
  for (const double r : residual)
    if (r <= 3 * options.outlier_px) squares += r * r, ++result.used;
  result.target_from_reference = as_matrix(h);
  result.rms_px = result.used ? std::sqrt(squares / static_cast<double>(result.used)) : 0;
  result.solved = result.used >= 8 && h.allFinite();
  return result;
}

FitPerspectiveResult fit_perspective(const FlowField& flow, const Image* mask, const FitPerspectiveOptions& options) {
  const auto count = static_cast<std::size_t>(flow.width) * static_cast<std::size_t>(flow.height);
  check(flow.displacement_px.size() == count && flow.valid.size() == count, "flow has ", flow.displacement_px.size(),
        " displacements, expected ", count);
  if (mask) {
    check(mask->pixels.size() == static_cast<std::size_t>(mask->width) * static_cast<std::size_t>(mask->height) *
                                     static_cast<std::size_t>(mask->channels),
          "mask has ", mask->pixels.size(), " values, expected ", mask->width, " x ", mask->height, " pixels of ",
          mask->channels, " channels");
    check(mask->width == flow.width && mask->height == flow.height, "mask is ", mask->width, " x ", mask->height,
          " pixels, flow is ", flow.width, " x ", flow.height);
  }
  std::vector<PointPair> pairs;
  const int stride = static_cast<int>(options.stride_px);
  for (int y = 0; y < flow.height; y += stride)
    for (int x = 0; x < flow.width; x += stride) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(flow.width) + static_cast<std::size_t>(x);
      if (!flow.valid[at] || (mask && mask->pixels[at * static_cast<std::size_t>(mask->channels)] < 128)) continue;
      const Vec2f& d = flow.displacement_px[at];
      pairs.push_back({1.0 * x, 1.0 * y, x + static_cast<double>(d[0]), y + static_cast<double>(d[1])});
    }
  return fit_points(pairs, options);
}

}  // namespace face::mmm
