// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/constraint_solver.h"

#include <Eigen/Dense>
#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/meshik/factor_space.h"
#include "nodes/meshik/gradient_sums.h"

namespace face::meshik {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

ConstraintSolver::ConstraintSolver(const MeshSpace& space, const VertexTargets& targets, double give_mm2)
    : space_(space), give_mm2_(give_mm2) {
  std::vector<std::size_t> all, with_z;
  for (std::size_t i = 0; i < targets.targets.size(); ++i) {
    const VertexTarget& target = targets.targets[i];
    check(target.vertex < space.vertex_count, "target ", i, " is vertex ", target.vertex, ", expected one below ",
          space.vertex_count);
    vertices_.push_back(target.vertex);
    all.push_back(i);
    if (target.has_z) with_z.push_back(i);
  }
  std::vector<std::uint32_t> sorted = vertices_;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) fail("vertex ", *twice, " is a target twice, expected every vertex at most once");

  const std::size_t count = free_count(space), columns = vertices_.size();
  lower_.assign(count * columns, 0.0);
  std::vector<double> four(4 * count);
  for (std::size_t first = 0; first < columns; first += 4) {
    std::fill(four.begin(), four.end(), 0.0);
    const std::size_t lanes = std::min<std::size_t>(4, columns - first);
    for (std::size_t l = 0; l < lanes; ++l)
      if (space.order[vertices_[first + l]] < count) four[4 * space.order[vertices_[first + l]] + l] = 1;
    solve_lower(space, four.data());
    for (std::size_t v = 0; v < count; ++v)
      for (std::size_t l = 0; l < lanes; ++l) lower_[v * columns + first + l] = four[4 * v + l];
  }
  const Eigen::Map<const RowMatrix> lower(lower_.data(), index(count), index(columns));
  schur_.resize(columns * columns);
  Eigen::Map<RowMatrix>(schur_.data(), index(columns), index(columns)).noalias() = lower.transpose() * lower;
  make_axis(all, xy_);
  make_axis(with_z, z_);
}

void ConstraintSolver::make_axis(const std::vector<std::size_t>& chosen, AxisConstraints& axis) const {
  axis.targets = chosen;
  for (const std::size_t i : chosen) axis.parts.push_back(space_.component[vertices_[i]]);
  std::sort(axis.parts.begin(), axis.parts.end());
  axis.parts.erase(std::unique(axis.parts.begin(), axis.parts.end()), axis.parts.end());
  const std::size_t n = chosen.size(), size = n + axis.parts.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(index(size), index(size));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) matrix(index(i), index(j)) = schur_[chosen[i] * vertices_.size() + chosen[j]];
    const auto part = std::lower_bound(axis.parts.begin(), axis.parts.end(), space_.component[vertices_[chosen[i]]]);
    const std::size_t column = n + static_cast<std::size_t>(part - axis.parts.begin());
    matrix(index(i), index(i)) += give_mm2_;
    matrix(index(i), index(column)) = matrix(index(column), index(i)) = 1;
  }
  axis.inverse.resize(size * size);
  if (size > 0) Eigen::Map<RowMatrix>(axis.inverse.data(), index(size), index(size)) = matrix.partialPivLu().inverse();
}

std::vector<double> ConstraintSolver::solve(std::vector<double>& sums, const VertexTargets& targets,
                                            const std::vector<double>& weights) const {
  solve_lower(space_, sums.data());
  const std::size_t count = free_count(space_), columns = vertices_.size();
  const Eigen::Map<const RowMatrix> lower(lower_.data(), index(count), index(columns));
  Eigen::Map<RowMatrix> x(sums.data(), index(count), 4);
  std::vector<std::vector<double>> shifts(3);
  // Where the constrained vertices are without a pull.
  const RowMatrix here = lower.transpose() * x.leftCols(3);
  RowMatrix pulls = RowMatrix::Zero(index(columns), 3);
  for (std::size_t d = 0; d < 3; ++d) {
    const AxisConstraints& axis = this->axis(d);
    const std::size_t n = axis.targets.size(), size = n + axis.parts.size();
    Eigen::VectorXd gap = Eigen::VectorXd::Zero(index(size));
    for (std::size_t i = 0; i < n; ++i) {
      const VertexTarget& target = targets.targets[axis.targets[i]];
      gap[index(i)] = (d == 0   ? target.x_mm
                       : d == 1 ? target.y_mm
                                : target.z_mm) -
                      here(index(axis.targets[i]), index(d));
    }
    const Eigen::VectorXd answer = Eigen::Map<const RowMatrix>(axis.inverse.data(), index(size), index(size)) * gap;
    for (std::size_t i = 0; i < n; ++i) pulls(index(axis.targets[i]), index(d)) = answer[index(i)];
    shifts[d].assign(answer.data() + n, answer.data() + size);
  }
  x.leftCols(3).noalias() += lower * pulls;
  solve_transpose(space_, sums.data());

  std::vector<double> vertices = unpack_vertices(space_, sums);
  const std::size_t parts = space_.centroids_mm.size() / 3 / (1 + static_cast<std::size_t>(space_.example_count));
  for (std::size_t d = 0; d < 3; ++d) {
    const AxisConstraints& axis = this->axis(d);
    std::vector<double> shift(parts, 0.0);
    std::vector<bool> placed(parts, false);
    for (std::size_t i = 0; i < axis.parts.size(); ++i) {
      shift[axis.parts[i]] = shifts[d][i];
      placed[axis.parts[i]] = true;
    }
    for (std::size_t v = 0; v < space_.component.size(); ++v) vertices[3 * v + d] += shift[space_.component[v]];
    move_centroids(space_, weights, {d == 0, d == 1, d == 2}, placed, vertices);
  }
  return vertices;
}

}  // namespace face::meshik
