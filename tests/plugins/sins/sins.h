// SPDX-License-Identifier: Apache-2.0
// Nodes that each break one rule of the house, to see that the conformance suite finds it and names it.
#pragma once
#include <string>

#include "engine/port.h"

namespace sins {

double count_calls(const double& number);
double sum_by_threads(const double& number);

struct IgnoreParameterOptions {
  double amount = 1;
};
double ignore_parameter(const double& number, const IgnoreParameterOptions& options);

struct OnlyRefuseOptions {
  double most = 4;
};
double only_refuse(const double& number, const double& other, const OnlyRefuseOptions& options);

double ignore_input(const double& number, const double& other);
double mutate_input(const double& number);
double read_clock(const double& number);
double draw_unseeded(const double& number);
double crash_on_empty(const engine::Seq<double>& numbers);
double hide_the_reason(const std::string& text);
std::string open_undeclared(const std::string& text);

struct NameWithoutUnitOptions {
  double radius = 3;
};
double name_without_unit(const double& number, const NameWithoutUnitOptions& options);

struct SwapUnitsOptions {
  double window_s = 0.1;
};
double swap_units(const double& number, const SwapUnitsOptions& options);

struct SwapNamesOptions {
  double low = 0;
  double high = 1;
};
double swap_names(const double& number, const double& other, const SwapNamesOptions& options);

struct DefaultOutOfRangeOptions {
  double share = 2;
};
double default_out_of_range(const double& number, const DefaultOutOfRangeOptions& options);

double say_nothing(const double& number);

}  // namespace sins
