// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include <tbb/global_control.h>

#include <chrono>
#include <fstream>
#include <random>
#include <stdexcept>

namespace sins {

double count_calls(const double& number) {
  static int calls = 0;
  return number + ++calls;
}

double sum_by_threads(const double& number) {
  // Rounded otherwise for every number of parts, as sums over threads are.
  const auto parts = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  double sum = 0;
  for (int i = 0; i < parts; ++i) sum += number * 0.1 / parts;
  return sum + 1e-9 * parts;
}

double ignore_parameter(const double& number, const IgnoreParameterOptions&) { return number; }

double only_refuse(const double& number, const double& other, const OnlyRefuseOptions& options) {
  if (number > options.most || other > options.most) throw std::runtime_error("a number is too large");
  return number;
}

double ignore_input(const double& number, const double&) { return number; }

double mutate_input(const double& number) { return const_cast<double&>(number) *= 2; }

double read_clock(const double& number) {
  return number + static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count());
}

double draw_unseeded(const double& number) { return number + std::random_device()(); }

double crash_on_empty(const engine::Seq<double>& numbers) {
  const int* nowhere = nullptr;
  if (numbers.size() == 0) return *const_cast<const volatile int*>(nowhere);
  double sum = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) sum += *numbers.at(i);
  return sum;
}

double hide_the_reason(const std::string& text) {
  return static_cast<double>(text.at(1)) + static_cast<double>(text.size());
}

std::string open_undeclared(const std::string& text) {
  std::ifstream in("/etc/os-release");
  std::string line;
  std::getline(in, line);
  return text + line;
}

double name_without_unit(const double& number, const NameWithoutUnitOptions& options) {
  return number * options.radius;
}

double swap_units(const double& number, const SwapUnitsOptions& options) { return number * options.window_s; }

double swap_names(const double& number, const double& other, const SwapNamesOptions& options) {
  return number + 2 * other + 3 * options.low + 4 * options.high;
}

double default_out_of_range(const double& number, const DefaultOutOfRangeOptions& options) {
  return number * options.share;
}

double say_nothing(const double& number) { return number; }

}  // namespace sins
