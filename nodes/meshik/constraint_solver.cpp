// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/constraint_solver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <optional>

#include "nodes/base/check.h"
#include "nodes/meshik/factor_space.h"
#include "nodes/meshik/gradient_sums.h"

namespace face::meshik {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

using Four [[gnu::vector_size(32), gnu::aligned(8)]] = double;

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

  reach();
  const std::size_t columns = vertices_.size();
  const Eigen::Map<const RowMatrix> lower(lower_.data(), index(reached_.size()), index(columns));
  schur_.resize(columns * columns);
  Eigen::Map<RowMatrix>(schur_.data(), index(columns), index(columns)).noalias() = lower.transpose() * lower;
  make_axis(all, xy_);
  make_axis(with_z, z_);
}

void ConstraintSolver::reach() {
  const std::size_t count = free_count(space_), columns = vertices_.size();
  constexpr std::uint32_t nowhere = 0xFFFFFFFF;
  std::vector<std::uint32_t> place(count, nowhere);
  // From every target up the elimination tree, where a column's parent is its first row below the diagonal.
  for (const std::uint32_t v : vertices_) {
    std::size_t j = space_.order[v];
    while (j < count && place[j] == nowhere) {
      place[j] = 0;
      const std::uint32_t next = space_.column_starts[j] + 1;
      j = next < space_.column_starts[j + 1] ? space_.rows[next] : count;
    }
  }
  for (std::uint32_t j = 0; j < count; ++j)
    if (place[j] != nowhere) {
      place[j] = static_cast<std::uint32_t>(reached_.size());
      reached_.push_back(j);
    }
  lower_.assign(reached_.size() * columns, 0.0);
  for (std::size_t i = 0; i < columns; ++i)
    if (space_.order[vertices_[i]] < count) lower_[place[space_.order[vertices_[i]]] * columns + i] = 1;
  for (std::size_t r = 0; r < reached_.size(); ++r) {
    double* const pivot = &lower_[r * columns];
    std::uint32_t p = space_.column_starts[reached_[r]];
    const std::uint32_t end = space_.column_starts[reached_[r] + 1];
    for (std::size_t i = 0; i < columns; ++i) pivot[i] *= space_.values[p];
    for (++p; p < end; ++p) {
      double* const row = &lower_[place[space_.rows[p]] * columns];
      for (std::size_t i = 0; i < columns; ++i) row[i] -= space_.values[p] * pivot[i];
    }
  }
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
  const std::size_t columns = vertices_.size();
  Four* const x = reinterpret_cast<Four*>(sums.data());
  std::vector<std::optional<double>> shift(3 * part_count(space_));
  // Where the constrained vertices are without a pull, and the pulls: x, y, z and a spare number of each.
  std::vector<double> here_of(4 * columns, 0.0), pulls_of(4 * columns, 0.0);
  Four* const here = reinterpret_cast<Four*>(here_of.data());
  Four* const pulls = reinterpret_cast<Four*>(pulls_of.data());
  for (std::size_t r = 0; r < reached_.size(); ++r)
    for (std::size_t i = 0; i < columns; ++i) here[i] += lower_[r * columns + i] * x[reached_[r]];
  for (std::size_t d = 0; d < 3; ++d) {
    const AxisConstraints& axis = this->axis(d);
    const std::size_t n = axis.targets.size(), size = n + axis.parts.size();
    Eigen::VectorXd gap = Eigen::VectorXd::Zero(index(size));
    for (std::size_t i = 0; i < n; ++i) {
      const VertexTarget& target = targets.targets[axis.targets[i]];
      gap[index(i)] = (d == 0 ? target.x_mm : d == 1 ? target.y_mm : target.z_mm) - here[axis.targets[i]][d];
    }
    const Eigen::VectorXd answer = Eigen::Map<const RowMatrix>(axis.inverse.data(), index(size), index(size)) * gap;
    for (std::size_t i = 0; i < n; ++i) pulls[axis.targets[i]][d] = answer[index(i)];
    for (std::size_t i = n; i < size; ++i) shift[3 * axis.parts[i - n] + d] = answer[index(i)];
  }
  for (std::size_t r = 0; r < reached_.size(); ++r)
    for (std::size_t i = 0; i < columns; ++i) x[reached_[r]] += lower_[r * columns + i] * pulls[i];
  solve_transpose(space_, sums.data());

  std::vector<double> vertices = unpack_vertices(space_, sums);
  move_parts(space_, weights, shift, vertices);
  return vertices;
}

}  // namespace face::meshik
