// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/orient.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "nodes/align/marker_points.h"
#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/base/random.h"
#include "nodes/base/scan_points.h"

namespace face::align {
namespace {

using Point = std::array<double, 3>;

constexpr double scale_of_median = 1.2;

Point moved(const RigidMotion& m, const Point& p) {
  Point out{};
  for (std::size_t r = 0; r < 3; ++r) {
    out[r] = m.translation_mm[r];
    for (std::size_t c = 0; c < 3; ++c) out[r] += m.rotation[r * 3 + c] * p[c];
  }
  return out;
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

std::map<std::string, Point> points_of(const DepthScan& scan, const Landmarks& markers) {
  std::map<std::string, Point> out;
  const ScanRays rays(scan.camera);
  for (const MarkerPoint& marker : marker_points(scan, markers)) {
    const Vec3f p = rays.point(marker.x_px, marker.y_px, static_cast<float>(marker.depth_mm));
    out[marker.name] = {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  return out;
}

}  // namespace

AbsoluteOrientation absolute_orientation(const std::vector<Point>& from_mm, const std::vector<Point>& to_mm,
                                         const std::vector<double>& weights) {
  check(from_mm.size() == to_mm.size() && weights.size() == from_mm.size(), "from_mm has ", from_mm.size(),
        " points, to_mm ", to_mm.size(), ", weights ", weights.size());
  AbsoluteOrientation result;
  double total = 0;
  Eigen::Vector3d from_mean = Eigen::Vector3d::Zero(), to_mean = from_mean;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    total += weights[i];
    from_mean += weights[i] * Eigen::Vector3d(from_mm[i].data());
    to_mean += weights[i] * Eigen::Vector3d(to_mm[i].data());
  }
  if (weights.size() < 3 || !(total > 0)) return result;
  from_mean /= total;
  to_mean /= total;
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < weights.size(); ++i)
    h += weights[i] * (Eigen::Vector3d(from_mm[i].data()) - from_mean) *
         (Eigen::Vector3d(to_mm[i].data()) - to_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // On a line two singular values are 0 and the turn about it is free.
  if (!(svd.singularValues()(1) > 1e-6 * svd.singularValues()(0)) || !(svd.singularValues()(0) > 0)) return result;
  Eigen::Vector3d signs(1, 1, (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1);
  const Eigen::Matrix3d rotation = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  const Eigen::Vector3d translation = to_mean - rotation * from_mean;
  for (Eigen::Index r = 0; r < 3; ++r) {
    for (Eigen::Index c = 0; c < 3; ++c) result.to_from.rotation[static_cast<std::size_t>(r * 3 + c)] = rotation(r, c);
    result.to_from.translation_mm[static_cast<std::size_t>(r)] = translation(r);
  }
  double square = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    square += weights[i] * std::pow(distance(moved(result.to_from, from_mm[i]), to_mm[i]), 2);
  result.rms_mm = std::sqrt(square / total);
  result.solved = true;
  return result;
}

OrientResult orient(const DepthScan& scan, const Landmarks& markers, const DepthScan& reference,
                    const Landmarks& reference_markers, const OrientOptions& options, engine::Progress& progress) {
  check_scan(scan, "scan");
  check_scan(reference, "reference");
  OrientResult result;
  result.aligned = scan;
  const std::map<std::string, Point> here = points_of(scan, markers), there = points_of(reference, reference_markers);
  std::vector<std::string> rigid = options.rigid;
  if (rigid.empty()) {
    std::vector<std::pair<double, std::string>> by_height;
    for (const auto& [name, p] : there) by_height.push_back({-p[1], name});
    std::sort(by_height.begin(), by_height.end());
    const auto keep = static_cast<std::size_t>(std::ceil(options.upper_share * static_cast<double>(by_height.size())));
    for (std::size_t i = 0; i < keep; ++i) rigid.push_back(by_height[i].second);
  }
  std::vector<Point> from, to;
  for (const std::string& name : rigid) {
    const auto a = here.find(name), b = there.find(name);
    if (a == here.end() || b == there.end()) continue;
    from.push_back(a->second);
    to.push_back(b->second);
  }
  // The start that half of the markers agree with best, of 100 triples (least median of squares: Rousseeuw 1984).
  Random random(7);
  AbsoluteOrientation best;
  double least = 1e30;
  for (int round = 0; round < 100 && from.size() >= 3; ++round) {
    std::vector<Point> a, b;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(random.uniform() * static_cast<double>(from.size()));
      a.push_back(from[i]);
      b.push_back(to[i]);
    }
    const AbsoluteOrientation guess = absolute_orientation(a, b, {1, 1, 1});
    if (!guess.solved) continue;
    std::vector<double> errors;
    for (std::size_t i = 0; i < from.size(); ++i) errors.push_back(distance(moved(guess.to_from, from[i]), to[i]));
    const double usual = median(std::move(errors));
    if (usual < least) least = usual, best = guess;
  }
  const auto give_up = [&] {
    if (there.empty())
      progress.warn(
          "the head's motion is not known: the reference has no markers, expected painted dots of about the "
          "radius that align.find_markers is told; left out");
    else
      progress.warn(message("the head's motion is not known: of ", rigid.size(), " markers that the jaw does not move ",
                            from.size(), " are measured, and no three of them agree with the reference; left out"));
    return result;
  };
  if (!best.solved) return give_up();
  const double scale_mm = std::max(options.scale_mm, scale_of_median * least);
  std::vector<double> weights(from.size(), 1);
  for (int round = 0; round < 30; ++round) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      const double e = distance(moved(best.to_from, from[i]), to[i]) / scale_mm;
      weights[i] = 1 / ((1 + e * e) * (1 + e * e));
    }
    const AbsoluteOrientation next = absolute_orientation(from, to, weights);
    if (!next.solved) return give_up();
    const bool settled = std::fabs(next.rms_mm - best.rms_mm) < 1e-9;
    best = next;
    if (settled && round > 2) break;
  }
  for (const double w : weights) result.used += w >= 0.25 ? 1 : 0;
  if (result.used < 3) {
    result.used = 0;
    return give_up();
  }
  result.reference_from_scan = best.to_from;
  result.rms_mm = best.rms_mm;
  result.solved = true;
  result.aligned.camera = moved_camera(scan.camera, best.to_from);
  return result;
}

}  // namespace face::align
