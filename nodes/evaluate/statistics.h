// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "nodes/base/quantile.h"
#include "nodes/types/table.h"

namespace face::evaluate {

// All are NaN for an empty list: nothing was measured.
double mean_of(const std::vector<double>& values);
double rms_of(const std::vector<double>& values);
double largest_of(const std::vector<double>& values);
// Divides by the count, as numpy's std.
double deviation_of(const std::vector<double>& values);
// Share of the values that are at most `most`, in percent.
double percent_within(const std::vector<double>& values, double most);

// part of whole, in percent; NaN where whole is 0.
double percent_of(double part, double whole);

// A table with one row.
Table one_row(std::string name, std::vector<std::string> columns, std::vector<double> values);

}  // namespace face::evaluate
