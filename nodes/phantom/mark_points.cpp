// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/mark_points.h"

#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/phantom/person_random.h"

namespace face::phantom {

Landmarks mark_points(const Landmarks& exact, const std::string* id, const MarkPointsOptions& options) {
  Random random = series(person_seed(options.seed, id), 23);
  Landmarks marked;
  for (const std::string& name : options.names) {
    const auto found = std::find_if(exact.points.begin(), exact.points.end(),
                                    [&](const Landmark& point) { return point.name == name; });
    check(found != exact.points.end(), "there is no point \"", name, "\" among the ", exact.points.size(), " given");
    // Drawn for hidden points too: one point's error does not depend on whether another is seen.
    const double dx = options.error_px * random.normal(), dy = options.error_px * random.normal();
    if (found->valid) marked.points.push_back({name, found->x_px + dx, found->y_px + dy, true});
  }
  return marked;
}

}  // namespace face::phantom
