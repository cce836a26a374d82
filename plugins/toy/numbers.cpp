// SPDX-License-Identifier: Apache-2.0
#include "plugins/toy/numbers.h"

#include <charconv>

namespace toy {

double add(const double& a, const double* b, const AddOptions& options) { return a + (b ? *b : 0) + options.amount; }

double window_mean(const engine::Window<double>& values) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i];
  return sum / static_cast<double>(values.size());
}

RunningSum running_sum(const double& value, const engine::Prior<RunningSum>& prior) {
  return {(prior ? prior->total : 0) + value};
}

double sum_all(const engine::Seq<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number;
  return sum;
}

std::string number_text(const double& number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number, std::chars_format::fixed).ptr};
}

double random_number(const std::string& id, const RandomNumberOptions& options) {
  std::uint64_t state = static_cast<std::uint64_t>(options.seed) * 0x9e3779b97f4a7c15ull;
  for (const char c : id) state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  state ^= state >> 31;
  state *= 0x94d049bb133111ebull;
  return static_cast<double>((state ^ (state >> 29)) >> 11) * 0x1.0p-53;
}

}  // namespace toy
