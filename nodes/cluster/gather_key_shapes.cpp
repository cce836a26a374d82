// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/gather_key_shapes.h"

#include <algorithm>

#include "nodes/base/check.h"

namespace face::cluster {

KeyShapes gather_key_shapes(const engine::Seq<Landmarks>& tracks, const Matrix& frames, const Matrix& labels,
                            const Matrix& exemplars) {
  check(labels.values.size() == frames.values.size(), "labels has ", labels.values.size(), " numbers, expected ",
        frames.values.size(), " as there are frames");
  KeyShapes keys;
  for (std::size_t k = 0; k < exemplars.values.size(); ++k) {
    const double row = exemplars.values[k];
    check(row >= 0 && row < static_cast<double>(frames.values.size()), "exemplars holds ", row,
          ", expected a number below ", frames.values.size());
    const double at = frames.values[static_cast<std::size_t>(row)];
    check(at >= 0 && at < static_cast<double>(tracks.size()), "frames holds ", at, ", expected a number below ",
          tracks.size());
    const auto frame = static_cast<std::size_t>(at);
    KeyShape key{tracks.id(frame), 0, *tracks.at(frame)};
    key.size = std::count(labels.values.begin(), labels.values.end(), static_cast<double>(k));
    keys.shapes.push_back(std::move(key));
  }
  std::stable_sort(keys.shapes.begin(), keys.shapes.end(),
                   [](const KeyShape& a, const KeyShape& b) { return a.size > b.size; });
  return keys;
}

}  // namespace face::cluster
