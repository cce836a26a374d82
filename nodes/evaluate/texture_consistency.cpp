// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/texture_consistency.h"

#include <cmath>
#include <memory>
#include <vector>

#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/picture.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {

TextureConsistencyResult texture_consistency(const engine::Seq<Image>& rendered, const engine::Seq<Image>& frames,
                                             const engine::Seq<Image>* masks) {
  check_frame_counts(rendered.size(), frames.size(), "rendered", "frames");
  if (masks) check_frame_counts(masks->size(), frames.size(), "masks", "frames");
  TextureConsistencyResult result;
  result.frames.columns = {"rms_levels"};
  std::vector<double> measured;
  double squares = 0, pixels = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::shared_ptr<const Image> mask = masks ? masks->at(i) : nullptr;
    const Table seen = picture(*rendered.at(i), *frames.at(i), mask.get());
    const double rms = seen.rows[0].values[0], count = seen.rows[0].values[3];
    result.frames.rows.push_back({frames.id(i), {rms}});
    if (count == 0) continue;
    measured.push_back(rms);
    squares += count * rms * rms;
    pixels += count;
  }
  result.table = one_row(
      "all", {"rms_levels", "median_levels", "p95_levels", "worst_levels"},
      {std::sqrt(squares / pixels), quantile(measured, 0.5), quantile(measured, 0.95), largest_of(measured)});
  return result;
}

}  // namespace face::evaluate
