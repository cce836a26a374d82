// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/gram.h"

#include <immintrin.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace face::model {
namespace {

// Rows go in groups of 24: three registers of 8 numbers, or six of 4. A group's part of a run of columns is packed
// column by column, 24 numbers each.
constexpr std::size_t group = 24, run = 512, block = 4;  // groups per task and side

// sum (24 x 24) += left right', over `columns` columns. One number of left meets a register of right: a lane holds one
// sum, to which columns come in their order whatever the register's width.
using Multiply = void (*)(const double* left, const double* right, std::size_t columns, double* sum);

void multiply_by_4(const double* left, const double* right, std::size_t columns, double* sum) {
  for (std::size_t row = 0; row < group; row += 4)
    for (std::size_t column = 0; column < group; column += 12) {
      __m256d s[4][3];
      double* const at = sum + row * group + column;
      for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 3; ++c) s[r][c] = _mm256_loadu_pd(at + r * group + 4 * c);
      for (std::size_t k = 0; k < columns; ++k) {
        const double *const l = left + k * group + row, *const x = right + k * group + column;
        const __m256d x0 = _mm256_loadu_pd(x), x1 = _mm256_loadu_pd(x + 4), x2 = _mm256_loadu_pd(x + 8);
#pragma GCC unroll 4
        for (std::size_t r = 0; r < 4; ++r) {
          const __m256d a = _mm256_broadcast_sd(l + r);
          s[r][0] = _mm256_fmadd_pd(a, x0, s[r][0]);
          s[r][1] = _mm256_fmadd_pd(a, x1, s[r][1]);
          s[r][2] = _mm256_fmadd_pd(a, x2, s[r][2]);
        }
      }
      for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 3; ++c) _mm256_storeu_pd(at + r * group + 4 * c, s[r][c]);
    }
}

__attribute__((target("avx512f"))) void multiply_by_8(const double* left, const double* right, std::size_t columns,
                                                      double* sum) {
  for (std::size_t row = 0; row < group; row += 8) {
    __m512d s[8][3];
    double* const at = sum + row * group;
    for (std::size_t r = 0; r < 8; ++r)
      for (std::size_t c = 0; c < 3; ++c) s[r][c] = _mm512_loadu_pd(at + r * group + 8 * c);
    for (std::size_t k = 0; k < columns; ++k) {
      const double *const l = left + k * group + row, *const x = right + k * group;
      const __m512d x0 = _mm512_loadu_pd(x), x1 = _mm512_loadu_pd(x + 8), x2 = _mm512_loadu_pd(x + 16);
#pragma GCC unroll 8
      for (std::size_t r = 0; r < 8; ++r) {
        const __m512d a = _mm512_set1_pd(l[r]);
        s[r][0] = _mm512_fmadd_pd(a, x0, s[r][0]);
        s[r][1] = _mm512_fmadd_pd(a, x1, s[r][1]);
        s[r][2] = _mm512_fmadd_pd(a, x2, s[r][2]);
      }
    }
    for (std::size_t r = 0; r < 8; ++r)
      for (std::size_t c = 0; c < 3; ++c) _mm512_storeu_pd(at + r * group + 8 * c, s[r][c]);
  }
}

std::vector<double> sum_products(std::size_t rows, std::size_t columns, const RowPart& part, Multiply multiply) {
  const std::size_t groups = (rows + group - 1) / group, blocks = (groups + block - 1) / block;
  const auto tile = [](std::size_t row, std::size_t column) { return (row * (row + 1) / 2 + column) * group * group; };
  std::vector<double> sums(tile(groups, 0), 0.0), packed(groups * group * std::min(run, columns), 0.0);
  for (std::size_t start = 0; start < columns; start += run) {
    const std::size_t length = std::min(run, columns - start);
    tbb::parallel_for(std::size_t{0}, groups, [&](std::size_t g) {
      std::vector<double> row(length);
      double* const at = packed.data() + g * group * length;
      for (std::size_t r = 0; r < group; ++r) {
        if (g * group + r < rows)
          part(g * group + r, start, row);
        else
          std::fill(row.begin(), row.end(), 0.0);
        for (std::size_t k = 0; k < length; ++k) at[k * group + r] = row[k];
      }
    });
    tbb::parallel_for(std::size_t{0}, blocks * (blocks + 1) / 2, [&](std::size_t task) {
      std::size_t a = 0;
      while ((a + 1) * (a + 2) / 2 <= task) ++a;
      const std::size_t b = task - a * (a + 1) / 2;
      for (std::size_t i = a * block; i < std::min(groups, (a + 1) * block); ++i)
        for (std::size_t j = b * block; j <= std::min(i, (b + 1) * block - 1); ++j)
          multiply(packed.data() + i * group * length, packed.data() + j * group * length, length,
                   sums.data() + tile(i, j));
    });
  }
  std::vector<double> gram(rows * rows, 0.0);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      gram[i * rows + j] = sums[tile(i / group, j / group) + i % group * group + j % group];
  return gram;
}

}  // namespace

std::vector<double> gram_of(std::size_t rows, std::size_t columns, const RowPart& part) {
  return sum_products(rows, columns, part, __builtin_cpu_supports("avx512f") ? multiply_by_8 : multiply_by_4);
}

std::vector<double> gram_of_narrow(std::size_t rows, std::size_t columns, const RowPart& part) {
  return sum_products(rows, columns, part, multiply_by_4);
}

}  // namespace face::model
