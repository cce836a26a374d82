// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/npy.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"

namespace face::exports {
namespace {

std::vector<std::size_t> shape_of(const Matrix& matrix, NpyShape shape) {
  if (shape == NpyShape::vector) {
    check(matrix.rows == 1 || matrix.columns == 1, "the matrix has ", matrix.rows, " rows and ", matrix.columns,
          " columns, expected one row or one column for a list");
    return {matrix.values.size()};
  }
  if (shape == NpyShape::points) {
    check(matrix.columns % 3 == 0, "the matrix has ", matrix.columns, " columns, expected x, y, z of every point");
    if (matrix.rows == 1) return {matrix.columns / 3, 3};
    return {matrix.rows, matrix.columns / 3, 3};
  }
  return {matrix.rows, matrix.columns};
}

}  // namespace

engine::File npy(const Matrix& matrix, const NpyOptions& options) {
  check(matrix.values.size() == matrix.rows * matrix.columns, "the matrix holds ", matrix.values.size(),
        " numbers, expected ", matrix.rows, " x ", matrix.columns);
  const bool whole = options.numbers == NpyNumbers::integer;
  std::string header = std::string("{'descr': '") + (whole ? "<i8" : "<f8") + "', 'fortran_order': False, 'shape': (";
  const std::vector<std::size_t> shape = shape_of(matrix, options.shape);
  for (std::size_t i = 0; i < shape.size(); ++i) header += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  header += shape.size() == 1 ? ",), }" : "), }";
  header.append(63 - (10 + header.size()) % 64, ' ');  // numbers start at a multiple of 64 bytes
  header += '\n';

  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xFF);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  const std::size_t start = bytes.size();
  bytes.resize(start + 8 * matrix.values.size());
  for (std::size_t i = 0; i < matrix.values.size(); ++i) {
    const double value = matrix.values[i];
    if (whole) {
      check(value == std::floor(value) && std::abs(value) <= 9007199254740992.0, "row ", i / matrix.columns, " column ",
            i % matrix.columns, " of the matrix is ", value, ", expected a whole number");
      const auto integer = static_cast<std::int64_t>(value);
      std::memcpy(&bytes[start + 8 * i], &integer, 8);
    } else {
      std::memcpy(&bytes[start + 8 * i], &value, 8);
    }
  }
  return engine::File::from_bytes(std::move(bytes), ".npy");
}

}  // namespace face::exports
