// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/spoken_steps.h"

#include <algorithm>
#include <cmath>

namespace face::mmm {
namespace {

constexpr double shortest_closure_s = 0.045;
constexpr double closure_of_stop = 0.6;

// The share of a phone in which the lips are shut; 0 where they are not.
double closure_share(const std::string& label) {
  if (label == "P.c" || label == "B.c" || label == "M") return 1;
  return label == "P" || label == "B" ? closure_of_stop : 0;
}

}  // namespace

SpokenSteps spoken_steps(const Phones& phones, const std::vector<double>& time_s, bool hold_closures) {
  SpokenSteps steps;
  std::size_t p = 0;
  for (const double time : time_s) {
    while (p + 1 < phones.phones.size() && phones.phones[p].end_s <= time) ++p;
    steps.phone.push_back(p);
  }
  steps.held.assign(time_s.size(), false);
  for (std::size_t i = 0; hold_closures && !time_s.empty() && i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    const double share = closure_share(phone.label), length_s = share * (phone.end_s - phone.start_s);
    if (share == 0) continue;
    const double middle_s = phone.start_s + length_s / 2, half_s = std::max(length_s, shortest_closure_s) / 2;
    const auto begin = std::lower_bound(time_s.begin(), time_s.end(), middle_s - half_s);
    const auto end = std::upper_bound(begin, time_s.end(), middle_s + half_s);
    for (auto at = begin; at != end; ++at) {
      const auto step = static_cast<std::size_t>(at - time_s.begin());
      steps.phone[step] = i;
      steps.held[step] = true;
    }
    if (begin != end) continue;
    // Steps that are farther apart than a closure lasts.
    auto nearest = static_cast<std::size_t>(begin - time_s.begin());
    if (nearest == time_s.size()) --nearest;
    if (nearest > 0 && middle_s - time_s[nearest - 1] < std::abs(time_s[nearest] - middle_s)) --nearest;
    steps.phone[nearest] = i;
    steps.held[nearest] = true;
  }
  return steps;
}

std::vector<std::string> spoken_labels(const Phones& phones) {
  std::vector<std::string> labels;
  for (const Phone& phone : phones.phones) labels.push_back(phone.label);
  for (std::string* label : {&labels.front(), &labels.back()})
    if (*label == "SIL") *label = "SIL.edge";
  return labels;
}

std::vector<double> step_times(const std::vector<double>& frame_s, double end_s, std::size_t steps) {
  std::vector<double> time_s;
  for (std::size_t t = 0; t < frame_s.size(); ++t) {
    const double next_s = t + 1 < frame_s.size() ? frame_s[t + 1] : std::max(end_s, frame_s[t]);
    for (std::size_t k = 0; k < steps; ++k)
      time_s.push_back(frame_s[t] + (next_s - frame_s[t]) * static_cast<double>(k) / static_cast<double>(steps));
  }
  return time_s;
}

}  // namespace face::mmm
