// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"

namespace toy {

struct AddOptions {
  double amount = 0;
};
// a + b + amount.
double add(const double& a, const double* b, const AddOptions& options);

// Mean of a number and its two neighbours at each side.
double window_mean(const engine::Window<double>& values);

struct RunningSum {
  double total = 0;
};
// Sum of the numbers so far.
RunningSum running_sum(const double& value, const engine::Prior<RunningSum>& prior);

// The sum of all.
double sum_all(const engine::Seq<double>& numbers);

// A number in decimal digits.
std::string number_text(const double& number);

struct RandomNumberOptions {
  int seed = 1;
};
// A number in [0, 1) that depends on the seed and the element's id alone.
double random_number(const std::string& id, const RandomNumberOptions& options);

}  // namespace toy
