// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/factor_space.h"

#include <Eigen/Sparse>
#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/meshik/blend_tile.h"

namespace face::meshik {
namespace {

using Four [[gnu::vector_size(32), gnu::aligned(8)]] = double;
using Eight [[gnu::vector_size(32), gnu::aligned(4)]] = float;

}  // namespace

std::size_t free_count(const MeshSpace& space) {
  return space.column_starts.empty() ? 0 : space.column_starts.size() - 1;
}

void check_space(const MeshSpace& space) {
  const auto vertices = static_cast<std::size_t>(space.vertex_count);
  const std::size_t numbers = tile_count(space) * tile_lanes, count = free_count(space);
  std::size_t parts = 0;
  for (const std::uint32_t part : space.component)
    parts = part + std::size_t{1} > parts ? part + std::size_t{1} : parts;
  bool fits = space.triangles.size() % 3 == 0 && space.frames.size() == 6 * numbers &&
              space.gradients.size() == 4 * numbers && space.component.size() == vertices &&
              space.order.size() == vertices && moving_tile_count(space) <= tile_count(space) &&
              space.blends.size() == 9 * tile_lanes * moving_tile_count(space) * space.example_count &&
              space.centroids_mm.size() == 3 * parts * (1 + space.example_count) && !space.column_starts.empty() &&
              space.rows.size() == space.values.size() && space.column_starts.back() == space.values.size();
  for (const std::uint32_t v : space.triangles) fits = fits && v < vertices;
  for (const std::uint32_t v : space.order) fits = fits && v <= vertices;
  for (const std::uint32_t row : space.rows) fits = fits && row < count;
  for (std::size_t j = 0; fits && j < count; ++j) fits = space.column_starts[j] < space.column_starts[j + 1];
  check(fits, "the parts of the mesh space do not fit together, expected one from meshik.prepare");
}

void factor_space(MeshSpace& space) {
  const auto vertices = static_cast<std::size_t>(space.vertex_count);
  // Free vertices in their own order.
  std::vector<std::int32_t> place(vertices, -1);
  std::int32_t count = 0;
  std::uint32_t next_part = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (space.component[v] == next_part)
      ++next_part;  // the first of its part
    else
      place[v] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < space.triangles.size() / 3; ++j) {
    const HatGradients g = hat_gradients(space, j);
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        const std::int32_t row = place[space.triangles[3 * j + a]], column = place[space.triangles[3 * j + b]];
        if (row >= column && column >= 0)
          entries.emplace_back(row, column, g.along[a][0] * g.along[b][0] + g.along[a][1] * g.along[b][1]);
      }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor(matrix);
  check(factor.info() == Eigen::Success, "the reference mesh has triangles too thin to be solved for");

  const Eigen::SparseMatrix<double>& l = factor.matrixL().nestedExpression();
  space.order.assign(vertices, static_cast<std::uint32_t>(vertices));
  for (std::size_t v = 0; v < vertices; ++v)
    if (place[v] >= 0) space.order[v] = static_cast<std::uint32_t>(factor.permutationP().indices()[place[v]]);
  space.column_starts.assign(1, 0);
  for (Eigen::Index j = 0; j < l.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator i(l, j); i; ++i) {
      space.rows.push_back(static_cast<std::uint32_t>(i.row()));
      space.values.push_back(i.row() == j ? 1 / i.value() : i.value());
    }
    space.column_starts.push_back(static_cast<std::uint32_t>(space.rows.size()));
  }
}

void solve_lower(const MeshSpace& space, double* x) {
  Four* const lanes = reinterpret_cast<Four*>(x);
  const std::uint32_t* rows = space.rows.data();
  const double* values = space.values.data();
  const std::size_t count = free_count(space);
  for (std::size_t j = 0; j < count; ++j) {
    std::uint32_t p = space.column_starts[j];
    const std::uint32_t end = space.column_starts[j + 1];
    const Four pivot = lanes[j] * values[p];
    lanes[j] = pivot;
    for (++p; p < end; ++p) lanes[rows[p]] -= values[p] * pivot;
  }
}

void solve_transpose(const MeshSpace& space, double* x) {
  Four* const lanes = reinterpret_cast<Four*>(x);
  const std::uint32_t* rows = space.rows.data();
  const double* values = space.values.data();
  for (std::size_t j = free_count(space); j-- > 0;) {
    const std::uint32_t first = space.column_starts[j], end = space.column_starts[j + 1];
    // Two sums, so that one need not wait for the other.
    Four even = lanes[j], odd = {0, 0, 0, 0};
    std::uint32_t p = first + 1;
    for (; p + 1 < end; p += 2) {
      even -= values[p] * lanes[rows[p]];
      odd -= values[p + 1] * lanes[rows[p + 1]];
    }
    if (p < end) even -= values[p] * lanes[rows[p]];
    lanes[j] = (even + odd) * values[first];
  }
}

void solve_lower_wide(const MeshSpace& space, float* x, std::size_t width) {
  const std::size_t count = free_count(space), lanes = width / 8;
  for (std::size_t j = 0; j < count; ++j) {
    std::uint32_t p = space.column_starts[j];
    const std::uint32_t end = space.column_starts[j + 1];
    Eight* const pivot = reinterpret_cast<Eight*>(x + j * width);
    if (std::all_of(x + j * width, x + (j + 1) * width, [](float value) { return value == 0; })) continue;
    const auto scale = static_cast<float>(space.values[p]);
    for (std::size_t i = 0; i < lanes; ++i) pivot[i] *= scale;
    for (++p; p < end; ++p) {
      Eight* const row = reinterpret_cast<Eight*>(x + space.rows[p] * width);
      const auto value = static_cast<float>(space.values[p]);
      for (std::size_t i = 0; i < lanes; ++i) row[i] -= value * pivot[i];
    }
  }
}

}  // namespace face::meshik
