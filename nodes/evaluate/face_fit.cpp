// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/face_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "nodes/align/orient.h"
#include "nodes/base/check.h"
#include "nodes/base/mouth.h"
#include "nodes/base/pose.h"
#include "nodes/evaluate/rotation_angle.h"
#include "nodes/evaluate/statistics.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/skin_basis.h"

namespace face::evaluate {
namespace {

using Rows3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Matrix3d rotation_of(const Camera& camera) {
  Rows3 r;
  for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = camera.cam_from_world[static_cast<std::size_t>(i)];
  return r;
}

Eigen::Matrix3d rotation_of(const RigidMotion& motion) { return Eigen::Map<const Rows3>(motion.rotation.data()); }

double angle_deg(const Eigen::Matrix3d& rotation) {
  std::array<double, 9> rows{};
  Eigen::Map<Rows3>(rows.data()) = rotation;
  return rotation_angle_deg(rows);
}

}  // namespace

Table face_fit(const MorphableModel& model, const FaceFit& fit, const Rig& rig, const Weights& weights,
               const RigidMotion* world_from_head, const Camera& camera, const FaceFit* start,
               const RigidMotion* start_world_from_head) {
  check(rig.neutral.points_mm.size() == model.mean.points_mm.size(), "the rig has ", rig.neutral.points_mm.size(),
        " vertices, the model ", model.mean.points_mm.size());
  const RigidMotion rest;
  const Eigen::Matrix3d truth = rotation_of(camera) * rotation_of(world_from_head != nullptr ? *world_from_head : rest);
  const std::vector<Vec3f> real = pose_points(rig, weights);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  double vertex = nan, shape = nan, shape_p90 = nan, size = nan, pose = nan, gap = nan;
  const double true_gap = lip_gap_mm(rig, real);
  if (!fit.identity.empty() || !fit.expression.empty()) {
    const std::vector<Vec3f> found = model::pose_model(model, fit.identity, fit.expression);
    std::vector<std::array<double, 3>> from, to;
    for (const std::uint32_t v : model::make_skin_basis(model, 0, 0, 0).vertices) {
      from.push_back({found[v][0], found[v][1], found[v][2]});
      to.push_back({real[v][0], real[v][1], real[v][2]});
    }
    const align::AbsoluteOrientation together =
        align::absolute_orientation(from, to, std::vector<double>(from.size(), 1.0));
    const Eigen::Matrix3d own = rotation_of(together.to_from);
    const auto vec = [](const std::array<double, 3>& p) { return Eigen::Map<const Eigen::Vector3d>(p.data()); };
    Eigen::Vector3d found_middle = Eigen::Vector3d::Zero(), real_middle = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
      found_middle += vec(from[i]) / static_cast<double>(from.size());
      real_middle += vec(to[i]) / static_cast<double>(from.size());
    }
    // Of rotated fits the scale that is best: the same rotation and middles serve with and without it.
    double along = 0, squares = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Eigen::Vector3d arm = own * (vec(from[i]) - found_middle);
      along += arm.dot(vec(to[i]) - real_middle);
      squares += arm.squaredNorm();
    }
    const double scale = along / squares;
    std::vector<double> distances, shape_distances;
    for (std::size_t i = 0; i < from.size() && together.solved; ++i) {
      const Eigen::Vector3d arm = own * (vec(from[i]) - found_middle), real_arm = vec(to[i]) - real_middle;
      distances.push_back((arm - real_arm).norm());
      shape_distances.push_back((scale * arm - real_arm).norm());
    }
    vertex = quantile(distances, 0.5);
    shape = quantile(shape_distances, 0.5);
    shape_p90 = quantile(shape_distances, 0.9);
    if (together.solved) size = 100 * (1 / scale - 1);
    gap = std::abs(fit.lip_gap_mm - true_gap);
    const Eigen::Matrix3d seen = rotation_of(fit.camera);
    if (start != nullptr) {
      const Eigen::Matrix3d moved = seen * rotation_of(start->camera).transpose();
      const Eigen::Matrix3d true_start =
          rotation_of(camera) * rotation_of(start_world_from_head != nullptr ? *start_world_from_head : rest);
      pose = angle_deg(moved * (truth * true_start.transpose()).transpose());
    } else if (together.solved) {
      pose = angle_deg(seen * own.transpose() * truth.transpose());
    }
  }
  const double turn = std::acos(std::clamp(truth(2, 2), -1.0, 1.0)) * 180 / std::numbers::pi;
  return one_row("fit",
                 {"vertex_mm", "shape_mm", "shape_p90_mm", "size_percent", "pose_deg", "lip_gap_mm", "true_gap_mm",
                  "turn_deg", "landmark_percent", "image_percent", "converged"},
                 {vertex, shape, shape_p90, size, pose, gap, true_gap, turn, 100 * fit.landmark_nme,
                  100 * fit.image_rms, fit.converged ? 1.0 : 0.0});
}

}  // namespace face::evaluate
