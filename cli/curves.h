// SPDX-License-Identifier: Apache-2.0
// Numbers as curves, for pages.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace cli {

// With six digits at most.
std::string short_number(double value);

// A curve, and what it goes from and to. `count`: how many there are of which these were chosen.
std::string curve_html(const std::vector<double>& values, std::size_t count);

// Lists of numbers over their elements: a curve for each of the few places that change most.
// Empty where nothing changes. count: as above.
std::string curves_html(const std::vector<std::vector<double>>& lists, std::size_t count);

}  // namespace cli
