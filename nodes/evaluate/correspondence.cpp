// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/correspondence.h"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/eigen_vector.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/draw_heat_map.h"
#include "nodes/evaluate/regions.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

Eigen::Vector3d middle_of(const std::vector<std::uint32_t>& vertices, const std::vector<Vec3f>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t v : vertices) sum += vector_of(points[v]);
  return sum / static_cast<double>(vertices.size());
}

struct Fit {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
};

Fit fit(const std::vector<std::uint32_t>& vertices, const std::vector<Vec3f>& points, const std::vector<Vec3f>& truth) {
  check(vertices.size() >= 3, "rigid has ", vertices.size(), " vertices, expected at least 3");
  const Eigen::Vector3d from = middle_of(vertices, points), to = middle_of(vertices, truth);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t v : vertices)
    covariance += (vector_of(truth[v]) - to) * (vector_of(points[v]) - from).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1, 1);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign(2) = -1;
  Fit found;
  found.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  found.translation = to - found.rotation * from;
  return found;
}

}  // namespace

CorrespondenceResult correspondence(const Rig& rig, const MeshPoints& points, const MeshPoints& truth,
                                    const VertexMask* rigid, const CorrespondenceOptions& options) {
  const std::size_t count = rig.neutral.points_mm.size();
  check_points(points, count, "points", "0");
  check_points(truth, count, "truth", "0");
  const std::vector<std::uint32_t> still =
      chosen_vertices(rigid, count, "rigid", rigid ? std::vector<std::uint32_t>() : jaw_free_vertices(rig));
  const Fit motion = fit(still, points.points_mm, truth.points_mm);
  std::vector<double> error_mm;
  for (std::size_t v = 0; v < count; ++v)
    error_mm.push_back(
        (motion.rotation * vector_of(points.points_mm[v]) + motion.translation - vector_of(truth.points_mm[v])).norm());
  CorrespondenceResult result;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      result.truth_from_points.rotation[static_cast<std::size_t>(3 * r + c)] = motion.rotation(r, c);
    result.truth_from_points.translation_mm[static_cast<std::size_t>(r)] = motion.translation(r);
  }
  result.table.columns = {"mean_mm", "median_mm", "p95_mm", "max_mm", "vertices"};
  for (const Region& region : face_regions(rig)) {
    std::vector<double> errors;
    for (const std::uint32_t v : region.vertices) errors.push_back(error_mm[v]);
    result.table.rows.push_back({region.name,
                                 {mean_of(errors), quantile(errors, 0.5), quantile(errors, 0.95), largest_of(errors),
                                  static_cast<double>(errors.size())}});
  }
  result.heat_map = draw_heat_map(rig, error_mm, options.full_scale_mm);
  return result;
}

}  // namespace face::evaluate
