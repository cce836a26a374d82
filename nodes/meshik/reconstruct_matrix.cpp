// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/reconstruct_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/meshik/prepare.h"
#include "nodes/meshik/reconstruct.h"

namespace face::meshik {
namespace {

void check_numbers(const Matrix& matrix, const char* name) {
  check(matrix.values.size() == matrix.rows * matrix.columns, name, " holds ", matrix.values.size(),
        " numbers, expected ", matrix.rows, " x ", matrix.columns);
}

}  // namespace

Matrix reconstruct_matrix(const Matrix& reference, const Matrix& examples, const Matrix& faces, const Matrix& weights) {
  check_numbers(reference, "reference");
  check_numbers(examples, "examples");
  check_numbers(faces, "faces");
  check_numbers(weights, "weights");
  check(reference.columns == 3, "reference has ", reference.columns, " columns, expected x, y, z");
  check(faces.columns == 3 || faces.columns == 4, "faces has ", faces.columns, " columns, expected 3 or 4 vertices");
  const std::size_t size = reference.values.size();
  check(size > 0 && examples.values.size() % size == 0 && (examples.columns == size || examples.columns == 3),
        "examples is ", examples.rows, " x ", examples.columns, ", expected K x ", size, " as reference has ",
        reference.rows, " vertices");
  std::vector<std::vector<double>> poses;
  for (std::size_t i = 0; i < examples.values.size(); i += size)
    poses.emplace_back(examples.values.begin() + static_cast<std::ptrdiff_t>(i),
                       examples.values.begin() + static_cast<std::ptrdiff_t>(i + size));
  std::vector<std::uint32_t> triangles;
  for (std::size_t f = 0; f < faces.rows; ++f) {
    for (std::size_t c = 0; c < faces.columns; ++c) {
      const double corner = faces.at(f, c);
      check(corner >= 0 && corner < static_cast<double>(reference.rows) && corner == std::floor(corner), "face ", f,
            " has vertex ", corner, ", expected a whole number from 0 to ", reference.rows - 1);
    }
    for (std::size_t c = 1; c + 1 < faces.columns; ++c)
      for (const std::size_t corner : {std::size_t{0}, c, c + 1})
        triangles.push_back(static_cast<std::uint32_t>(faces.at(f, corner)));
  }
  const bool one_frame = weights.columns == 1 && poses.size() != 1;
  const std::size_t frames = one_frame ? 1 : weights.rows, count = one_frame ? weights.rows : weights.columns;
  check(count == poses.size(), "weights is ", weights.rows, " x ", weights.columns, ", expected T x ", poses.size(),
        " as there are examples");
  const MeshSpace space = prepare_triangles(reference.values, triangles, poses);
  Matrix vertices{frames, size, std::vector<double>(frames * size)};
  for (std::size_t t = 0; t < frames; ++t) {
    const auto first = weights.values.begin() + static_cast<std::ptrdiff_t>(t * count);
    const std::vector<double> v =
        reconstruct_vertices(space, std::vector<double>(first, first + static_cast<std::ptrdiff_t>(count)));
    std::copy(v.begin(), v.end(), vertices.values.begin() + static_cast<std::ptrdiff_t>(t * size));
  }
  return vertices;
}

}  // namespace face::meshik
