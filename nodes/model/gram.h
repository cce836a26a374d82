// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace face::model {

// Writes columns first, first + 1, ... of one row, as many as out has.
using RowPart = std::function<void(std::size_t row, std::size_t first, std::span<double> out)>;

// A A' of a matrix A of rows x columns, which is asked for in parts and never held whole: rows x rows, row by row, the
// lower triangle with the diagonal; 0 above. Every number is one sum over the columns in their order, each step rounded
// once, so that it does not depend on the number of threads, nor on how wide the processor's registers are. part is
// called from several threads.
std::vector<double> gram_of(std::size_t rows, std::size_t columns, const RowPart& part);

// The same with 256 bits at a time where the processor could do more: for tests.
std::vector<double> gram_of_narrow(std::size_t rows, std::size_t columns, const RowPart& part);

}  // namespace face::model
