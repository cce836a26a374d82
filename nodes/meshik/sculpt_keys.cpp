// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/sculpt_keys.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/meshik/landmark_vertices.h"
#include "nodes/types/arkit.h"

namespace face::meshik {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Offsets of the landmarks' x and y by each shape that may be used; empty for the others.
std::vector<std::vector<double>> shape_rows(const Rig& rig, const std::vector<LandmarkVertex>& places) {
  std::vector<std::vector<double>> rows(rig.shapes.size());
  for (std::size_t s = 0; s < rig.shapes.size(); ++s) {
    const Shape& shape = rig.shapes[s];
    if (!shape.name.starts_with("jaw") && !shape.name.starts_with("mouth")) continue;
    std::vector<double> row(2 * places.size(), 0.0);
    bool moves = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto at = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), places[i].vertex);
      if (at == shape.vertices.end() || *at != places[i].vertex) continue;
      for (std::size_t d = 0; d < 2; ++d) {
        row[2 * i + d] =
            static_cast<double>(shape.offsets_mm[static_cast<std::size_t>(at - shape.vertices.begin())][d]);
        moves = moves || row[2 * i + d] != 0;
      }
    }
    if (moves) rows[s] = std::move(row);
  }
  return rows;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// What the weights of the shapes with rows are expected to be: the inverse of their covariance about 0, in the order of
// `used`. Without visemes every weight is expected alike.
MatrixXd expectation(const Rig& rig, const std::vector<std::vector<double>>& rows, const std::vector<std::size_t>& used,
                     const Visemes* visemes, const SculptKeysOptions& options) {
  const auto count = static_cast<Eigen::Index>(used.size());
  if (visemes == nullptr) {
    double mean = 0;
    for (const std::size_t s : used) mean += dot(rows[s], rows[s]) / static_cast<double>(used.size());
    return MatrixXd::Identity(count, count) * (options.restraint * mean);
  }
  constexpr double unknown = 0.2;  // deviation of a shape that the table cannot know
  std::vector<std::size_t> arkit;
  for (const std::size_t s : used)
    arkit.push_back(static_cast<std::size_t>(std::find(arkit_names.begin(), arkit_names.end(), rig.shapes[s].name) -
                                             arkit_names.begin()));
  std::vector<VectorXd> poses;
  const auto add = [&](const Viseme& viseme, const std::vector<float>& weights) {
    check(weights.size() == arkit_names.size(), "viseme ", viseme.label, " has ", weights.size(), " weights, expected ",
          arkit_names.size());
    VectorXd pose = VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::size_t k = arkit[static_cast<std::size_t>(i)];
      if (k < weights.size()) pose[i] = static_cast<double>(weights[k]);
    }
    poses.push_back(pose);
  };
  for (const Viseme& viseme : visemes->visemes) {
    add(viseme, viseme.weights);
    if (!viseme.glide_weights.empty()) add(viseme, viseme.glide_weights);
  }
  MatrixXd covariance = MatrixXd::Zero(count, count);
  for (const VectorXd& pose : poses)
    covariance += options.variety * options.variety / static_cast<double>(poses.size()) * pose * pose.transpose();
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool known = arkit[static_cast<std::size_t>(i)] < arkit_names.size();
    covariance(i, i) += std::pow(known ? options.own_deviation : unknown, 2);
  }
  return options.landmark_error_mm * options.landmark_error_mm * covariance.inverse();
}

// min |sum_s w_s row_s - wanted|^2 + w' expected w, 0 <= w <= 1, s of `used`; `wanted` becomes what is left.
std::vector<double> fit_box(const std::vector<std::vector<double>>& rows, const std::vector<std::size_t>& used,
                            const MatrixXd& expected, std::vector<double>& wanted) {
  const auto count = static_cast<Eigen::Index>(used.size());
  MatrixXd hessian = expected;
  VectorXd slope(count), weights = VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::vector<double>& row = rows[used[static_cast<std::size_t>(i)]];
    slope[i] = dot(row, wanted);
    for (Eigen::Index j = 0; j < count; ++j) hessian(i, j) += dot(row, rows[used[static_cast<std::size_t>(j)]]);
  }
  constexpr int most_sweeps = 20000;
  double largest = 1;
  for (int sweep = 0; sweep < most_sweeps && largest > 1e-9; ++sweep) {
    largest = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const double next = std::clamp(weights[i] + slope[i] / hessian(i, i), 0.0, 1.0), step = next - weights[i];
      weights[i] = next;
      slope -= step * hessian.col(i);
      largest = std::max(largest, std::abs(step));
    }
  }
  std::vector<double> all(rows.size(), 0.0);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t s = used[static_cast<std::size_t>(i)];
    all[s] = weights[i];
    for (std::size_t m = 0; m < wanted.size(); ++m) wanted[m] -= weights[i] * rows[s][m];
  }
  return all;
}

}  // namespace

SculptKeysResult sculpt_keys(const Rig& rig, const KeyShapes& key_shapes, const Landmarks& neutral,
                             const Visemes* visemes, engine::SeqWriter<Mesh>& key_meshes,
                             engine::SeqWriter<Weights>& rig_weights, const SculptKeysOptions& options) {
  const std::vector<LandmarkVertex> places = landmark_vertices(rig, neutral);
  for (const LandmarkVertex& place : places)
    check(place.vertex < rig.neutral.points_mm.size(), "a landmark is vertex ", place.vertex, ", expected one below ",
          rig.neutral.points_mm.size());
  SculptKeysResult result;
  result.reference = rig.neutral;
  result.mm_per_px = landmark_scale_mm(rig, neutral, places);
  const std::vector<std::vector<double>> rows = shape_rows(rig, places);
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!rows[i].empty()) used.push_back(i);
  check(!used.empty(), "no jaw or mouth shape of the rig moves a landmark");
  const MatrixXd expected = expectation(rig, rows, used, visemes, options);
  double squares = 0;
  for (const KeyShape& key : key_shapes.shapes) {
    check(key.landmarks.points.size() == neutral.points.size(), "key shape ", key.frame, " has ",
          key.landmarks.points.size(), " landmarks, expected ", neutral.points.size(), " as neutral");
    std::vector<double> wanted;
    for (const LandmarkVertex& place : places) {
      const Landmark &here = key.landmarks.points[place.landmark], &rest = neutral.points[place.landmark];
      check(here.name == rest.name, "landmark ", place.landmark, " of key shape ", key.frame, " is ", here.name,
            ", expected ", rest.name, " as of neutral");
      wanted.push_back(result.mm_per_px * (here.x_px - rest.x_px));
      wanted.push_back(-result.mm_per_px * (here.y_px - rest.y_px));
    }
    const std::vector<double> weights = fit_box(rows, used, expected, wanted);
    squares += dot(wanted, wanted) / static_cast<double>(places.size());
    Mesh mesh = rig.neutral;
    for (std::size_t s = 0; s < weights.size(); ++s) {
      const Shape& shape = rig.shapes[s];
      for (std::size_t i = 0; weights[s] > 0 && i < shape.vertices.size(); ++i)
        for (std::size_t d = 0; d < 3; ++d)
          mesh.points_mm[shape.vertices[i]][d] += static_cast<float>(weights[s]) * shape.offsets_mm[i][d];
    }
    key_meshes.push(std::move(mesh));
    rig_weights.push({std::vector<float>(weights.begin(), weights.end())});
  }
  if (!key_shapes.shapes.empty()) result.rms_mm = std::sqrt(squares / static_cast<double>(key_shapes.shapes.size()));
  return result;
}

}  // namespace face::meshik
