// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/solid_head.h"

#include <Eigen/Dense>
#include <cmath>

namespace face::track {
namespace {

using Place = std::complex<double>;
using Pose = Eigen::Matrix<double, 6, 1>;  // nod, turn, tilt, log of scale, place
using Turn = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Pose numbers_of(const HeadPose& pose) { return Pose(pose_numbers(pose).data()); }

Turn turn_of(const Pose& pose) {
  using Axis = Eigen::Vector3d;
  return std::exp(pose[3]) * (Eigen::AngleAxisd(pose[2], Axis::UnitZ()) * Eigen::AngleAxisd(pose[1], Axis::UnitY()) *
                              Eigen::AngleAxisd(pose[0], Axis::UnitX()))
                                 .toRotationMatrix();
}

}  // namespace

std::array<double, 6> pose_numbers(const HeadPose& pose) {
  return {pose.nod, pose.turn, pose.tilt, pose.log_scale, pose.x_px, pose.y_px};
}

HeadPose pose_of(const std::array<double, 6>& numbers) {
  const auto [nod, turn, tilt, log_scale, x_px, y_px] = numbers;
  return {nod, turn, tilt, log_scale, x_px, y_px};
}

Place SolidHead::seen(Place at_rest, double depth_px) const {
  const double x = at_rest.real() - origin_px[0], y = at_rest.imag() - origin_px[1], z = depth_px - origin_px[2];
  return place_px + Place(turn[0] * x + turn[1] * y + turn[2] * z, turn[3] * x + turn[4] * y + turn[5] * z);
}

Place SolidHead::at_rest(Place seen_px, double depth_px) const {
  const double z = depth_px - origin_px[2];
  const Place off = seen_px - place_px - Place(turn[2] * z, turn[5] * z);
  const double det = turn[0] * turn[4] - turn[1] * turn[3];
  return Place(origin_px[0], origin_px[1]) + Place((turn[4] * off.real() - turn[1] * off.imag()) / det,
                                                   (turn[0] * off.imag() - turn[3] * off.real()) / det);
}

SolidHead solid_head(const HeadPose& pose, const std::array<double, 3>& origin_px) {
  SolidHead head{origin_px, {}, {pose.x_px, pose.y_px}};
  const Turn turn = turn_of(numbers_of(pose));
  for (std::size_t i = 0; i < 9; ++i) head.turn[i] = turn.data()[i];
  return head;
}

SolidHead find_solid_head(const std::vector<SolidPoint>& points, Place similarity, const LikelyPose* likely) {
  constexpr double turn_deviation = 0.14, scale_deviation = 0.05, place_error_px = 0.7;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Place mean = 0;
  double total = 0;
  for (const SolidPoint& point : points) {
    total += point.weight;
    origin += point.weight * Eigen::Vector3d(point.at_rest.real(), point.at_rest.imag(), point.depth_px);
    mean += point.weight * point.seen;
  }
  origin /= total;
  mean /= total;
  Pose pose, usual = Pose::Zero(), known = Pose::Zero();  // mean and 1 / variance
  pose << 0, 0, std::arg(similarity), std::log(std::abs(similarity)), mean.real(), mean.imag();
  known[0] = known[1] = 1 / (turn_deviation * turn_deviation);
  known[3] = 1 / (scale_deviation * scale_deviation);
  for (int k = 0; likely != nullptr && k < 4; ++k) {  // the product of two normal distributions
    const double more = 1 / std::pow(numbers_of(likely->deviation)[k], 2);
    usual[k] = pose[k] = more * numbers_of(likely->mean)[k] / (known[k] + more);
    known[k] += more;
  }
  const auto see = [&](const Pose& at, const Eigen::Vector3d& rest) {
    return Eigen::Vector2d((turn_of(at) * (rest - origin)).head<2>() + at.tail<2>());
  };
  constexpr int most_steps = 30;
  constexpr double nudge = 1e-6, settled = 1e-8;
  for (int step = 0; step < most_steps; ++step) {
    Eigen::Matrix<double, 6, 6> hessian = known.asDiagonal();
    Pose slope = known.cwiseProduct(usual - pose);
    for (const SolidPoint& point : points) {
      const Eigen::Vector3d rest(point.at_rest.real(), point.at_rest.imag(), point.depth_px);
      const Eigen::Vector2d place = see(pose, rest);
      Eigen::Matrix<double, 2, 6> change;
      for (int k = 0; k < 6; ++k) {
        Pose moved = pose;
        moved[k] += nudge;
        change.col(k) = (see(moved, rest) - place) / nudge;
      }
      const double sure = point.weight / (place_error_px * place_error_px);
      hessian += sure * change.transpose() * change;
      slope += sure * change.transpose() * (Eigen::Vector2d(point.seen.real(), point.seen.imag()) - place);
    }
    const Pose move = hessian.ldlt().solve(slope);
    pose += move;
    if (move.cwiseAbs().maxCoeff() < settled) break;
  }
  return solid_head({pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]}, {origin[0], origin[1], origin[2]});
}

double usual_depth(const std::string& name) {
  if (name.starts_with("eye_inner")) return 0;
  if (name == "nose_tip") return 1.1;
  if (name == "lip_0" || name == "lip_6") return 0.4;
  if (name.starts_with("lip_")) return 0.7;
  if (name == "chin" || name.starts_with("jaw_")) return 0.3;
  return -1;
}

}  // namespace face::track
