// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/bake_shapes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"

namespace face::meshik {
namespace {

Eigen::VectorXf offsets(const Rig& rig, const engine::Seq<MeshPoints>& points, std::size_t frame) {
  const auto here = points.at(frame);
  const std::size_t count = rig.neutral.points_mm.size();
  if (here->points_mm.empty()) return {};
  check(here->points_mm.size() == count, "frame ", points.id(frame), " has ", here->points_mm.size(),
        " vertices, expected ", count, " as the rig");
  Eigen::VectorXf values(static_cast<Eigen::Index>(3 * count));
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t d = 0; d < 3; ++d)
      values[static_cast<Eigen::Index>(3 * i + d)] = here->points_mm[i][d] - rig.neutral.points_mm[i][d];
  return values;
}

double largest_length(const Eigen::VectorXf& values) {
  float squares = 0;
  for (Eigen::Index i = 0; i + 2 < values.size(); i += 3)
    squares = std::max(squares, values.segment<3>(i).squaredNorm());
  return std::sqrt(static_cast<double>(squares));
}

// The examined frames' offsets as columns.
Eigen::MatrixXf examine(const Rig& rig, const engine::Seq<MeshPoints>& points, std::size_t most) {
  const std::size_t step = std::max<std::size_t>(1, (points.size() + most - 1) / most);
  std::vector<Eigen::VectorXf> kept;
  for (std::size_t frame = 0; frame < points.size(); frame += step) {
    Eigen::VectorXf values = offsets(rig, points, frame);
    if (values.size() > 0) kept.push_back(std::move(values));
  }
  Eigen::MatrixXf columns(static_cast<Eigen::Index>(3 * rig.neutral.points_mm.size()),
                          static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = kept[i];
  return columns;
}

// Orthonormal columns, largest first, as many as leave no vertex of the examined frames more than the tolerance.
Eigen::MatrixXf components(Eigen::MatrixXf examined, const BakeShapesOptions& options) {
  if (examined.cols() == 0) return examined;  // no frame has vertices
  const Eigen::MatrixXd gram = (examined.transpose() * examined).cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  const Eigen::Index count = gram.rows();
  Eigen::MatrixXf basis(examined.rows(), std::min<Eigen::Index>(count, options.max_shapes));
  const Eigen::MatrixXf original = examined;
  Eigen::Index used = 0;
  while (used < basis.cols()) {
    double worst = 0;
    for (Eigen::Index i = 0; i < count; ++i) worst = std::max(worst, largest_length(examined.col(i)));
    if (worst <= options.tolerance_mm) break;
    Eigen::VectorXf shape = original * solver.eigenvectors().col(count - 1 - used).cast<float>();
    for (int twice = 0; twice < 2; ++twice)
      for (Eigen::Index k = 0; k < used; ++k) shape -= basis.col(k) * basis.col(k).dot(shape);
    const float length = shape.norm();
    if (!(length > 1e-4f)) break;
    basis.col(used) = shape / length;
    examined -= basis.col(used) * (basis.col(used).transpose() * examined);
    ++used;
  }
  return basis.leftCols(used);
}

}  // namespace

BakeShapesResult bake_shapes(const Rig& rig, const engine::Seq<MeshPoints>& points, engine::SeqWriter<Weights>& weights,
                             const BakeShapesOptions& options, engine::Progress& progress) {
  check(!points.empty(), "there are no frames");
  check(options.max_shapes > 0 && options.examined > 0, "max_shapes and examined are ", options.max_shapes, " and ",
        options.examined, ", expected at least 1");
  const Eigen::MatrixXf basis = components(examine(rig, points, static_cast<std::size_t>(options.examined)), options);
  const std::size_t shapes = static_cast<std::size_t>(basis.cols()), vertices = rig.neutral.points_mm.size();
  std::vector<Weights> frames;
  Eigen::VectorXf largest = Eigen::VectorXf::Zero(basis.cols());
  BakeShapesResult result;
  double squares = 0, counted = 0;
  for (std::size_t frame = 0; frame < points.size(); ++frame) {
    const Eigen::VectorXf values = offsets(rig, points, frame);
    if (values.size() == 0) {
      frames.push_back(frames.empty() ? Weights{std::vector<float>(shapes, 0.0f)} : Weights(frames.back()));
      continue;
    }
    const Eigen::VectorXf here = basis.transpose() * values;
    const Eigen::VectorXf left = values - basis * here;
    result.largest_mm = std::max(result.largest_mm, largest_length(left));
    squares += static_cast<double>(left.squaredNorm());
    counted += static_cast<double>(vertices);
    largest = largest.cwiseMax(here.cwiseAbs());
    frames.push_back({std::vector<float>(here.data(), here.data() + here.size())});
    progress.report(static_cast<double>(frame) / static_cast<double>(points.size()));
  }
  if (counted > 0) result.rms_mm = std::sqrt(squares / counted);
  result.rig = rig;
  result.rig.shapes.clear();
  result.rig.missing.clear();
  for (std::size_t s = 0; s < shapes; ++s) {
    const auto column = static_cast<Eigen::Index>(s);
    const float scale = largest[column] > 0 ? largest[column] : 1.0f;
    Shape shape{"motion_" + std::to_string(s), {}, {}};
    for (std::size_t i = 0; i < vertices; ++i) {
      const Eigen::Vector3f offset = scale * basis.col(column).segment<3>(static_cast<Eigen::Index>(3 * i));
      if (offset.squaredNorm() < 1e-8f) continue;  // 0.1 um
      shape.vertices.push_back(static_cast<std::uint32_t>(i));
      shape.offsets_mm.push_back({offset[0], offset[1], offset[2]});
    }
    result.rig.shapes.push_back(std::move(shape));
    for (Weights& frame : frames) frame.values[s] /= scale;
  }
  if (shapes == 0) {  // a photograph, a face that is never found: the head still goes where heads that move go
    result.rig.shapes.push_back({"motion_0", {}, {}});
    for (Weights& frame : frames) frame.values.assign(1, 0.0f);
  }
  for (std::size_t frame = 0; frame < frames.size(); ++frame) weights.push(points.id(frame), std::move(frames[frame]));
  return result;
}

}  // namespace face::meshik
