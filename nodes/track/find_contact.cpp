// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_contact.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"

namespace face::track {

void find_contact(const engine::Seq<double>& openings, engine::SeqWriter<double>& contacts,
                  const FindContactOptions& options) {
  check(options.shut_ratio < options.open_ratio, "shut_ratio is ", options.shut_ratio,
        ", expected less than open_ratio, which is ", options.open_ratio);
  std::vector<double> all, seen;
  for (const double opening : openings) {
    check(std::isfinite(opening), "the opening of frame ", openings.id(all.size()), " is ", opening,
          ", expected a finite number");
    all.push_back(opening);
    if (opening >= 0) seen.push_back(opening);
  }
  double shut = 0;
  if (!seen.empty()) {
    // Between two frames, so that one frame more changes little.
    std::sort(seen.begin(), seen.end());
    const double place = options.shut_share * static_cast<double>(seen.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double above = seen[std::min(below + 1, seen.size() - 1)];
    shut = seen[below] + (place - static_cast<double>(below)) * (above - seen[below]);
  }
  for (std::size_t t = 0; t < all.size(); ++t) {
    const double from = options.shut_ratio * shut, to = options.open_ratio * shut;
    double contact = 0;
    if (all[t] >= 0) contact = all[t] <= from ? 1 : all[t] >= to ? 0 : (to - all[t]) / (to - from);
    contacts.push(openings.id(t), contact);
  }
}

}  // namespace face::track
