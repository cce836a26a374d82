// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/lips_shut.h"

#include <algorithm>

namespace face::trajectory {

bool is_bilabial_closure(const std::string& label) {
  return label == "P.c" || label == "B.c" || label == "M" || label == "P" || label == "B";
}

double lips_shut(const Phones& phones, double time_s, double closing_s) {
  // Phones follow one another, so that the first one that may count is found by its end.
  auto phone = std::lower_bound(phones.phones.begin(), phones.phones.end(), time_s - closing_s,
                                [](const Phone& p, double t) { return p.end_s < t; });
  double most = 0;
  for (; phone != phones.phones.end() && phone->start_s <= time_s + closing_s; ++phone) {
    if (!is_bilabial_closure(phone->label)) continue;
    const double apart_s = std::max({phone->start_s - time_s, time_s - phone->end_s, 0.0});
    if (apart_s == 0) return 1;
    const double near = 1 - apart_s / closing_s;
    most = std::max(most, near * near * (3 - 2 * near));
  }
  return most;
}

}  // namespace face::trajectory
