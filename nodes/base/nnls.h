// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "nodes/types/matrix.h"

namespace face {

// Minimises |B w - t|^2 subject to w >= 0 (and, where asked for, sum w = 1) for many targets t over one basis B, all of
// them through the K x K matrix B'B, which is made once, and B't.
//
// Each solve starts from the columns that were in use at the last one, and exchanges all that violate the optimality
// conditions at a time (Portugal, Judice, Vicente, A Comparison of Block Pivoting and Interior-Point Algorithms for
// Linear Least Squares Problems with Nonnegative Variables, Mathematics of Computation 63, 1994); where that does not
// end, column by column (Lawson and Hanson, Solving Least Squares Problems, 1974, ch. 23). Factors are kept per set of
// columns in use. A result depends on the set alone, so the start changes no bit of it unless two sets are equally
// good.
class NonNegativeLeastSquares {
 public:
  // basis: M x K, K <= 63.
  explicit NonNegativeLeastSquares(const Matrix& basis, bool sum_to_one = false);

  std::size_t columns() const { return columns_; }

  // target: M values. weights: K, written. Returns the largest violation of the optimality conditions (negative weight,
  // gradient that is not 0 where the weight is not, or that points at less where it is), relative to the gradient's
  // parts: max |B'B| max |w| + max |B't|.
  double solve(const double* target, double* weights);

 private:
  struct Factor {
    bool regular = false;
    std::vector<std::size_t> used;
    std::vector<double> inverse;  // of B'B over the columns in use, P x P
    std::vector<double> share;    // inverse x 1, over its sum: what the sum-to-one condition moves
  };
  const Factor& factor(std::uint64_t used);
  bool try_set(std::uint64_t used, double* weights, double& multiplier);
  double slope(std::size_t column, const double* weights, double multiplier) const;
  bool exchange_blocks(double* weights);
  void exchange_singly(double* weights);

  std::size_t rows_ = 0, columns_ = 0;
  bool sum_to_one_ = false;
  std::vector<double> basis_, gram_, right_, trial_;
  double gram_size_ = 0, tolerance_ = 0;
  std::uint64_t used_ = 0;
  double multiplier_ = 0;
  std::map<std::uint64_t, Factor> factors_;
  const Factor* last_ = nullptr;
  std::uint64_t last_used_ = 0;
};

}  // namespace face
