// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/flow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

constexpr double step_px = 0.01;
constexpr std::size_t bins = 100000;  // up to 1000 px

void check_field(const FlowField& field, const char* name, const std::string& frame) {
  const auto pixels =
      static_cast<std::size_t>(std::max(0, field.width)) * static_cast<std::size_t>(std::max(0, field.height));
  check(field.displacement_px.size() == pixels && field.valid.size() == pixels, name, " of frame ", frame, " has ",
        field.displacement_px.size(), " displacements and ", field.valid.size(), " valid flags, expected ", pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    check(!field.valid[i] || (std::isfinite(field.displacement_px[i][0]) && std::isfinite(field.displacement_px[i][1])),
          name, " of frame ", frame, ": valid pixel ", i, " has no finite displacement");
}

class Histogram {
 public:
  Histogram() : counts_(bins, 0) {}
  void add(double value) {
    ++counts_[static_cast<std::size_t>(std::min(value / step_px, double{bins - 1}))];
    ++total_;
  }
  // Upper end of the bin in which the share q is reached.
  double quantile(double q) const {
    if (total_ == 0) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    std::size_t bin = 0;
    while (bin + 1 < bins && (sum += static_cast<double>(counts_[bin])) < q * static_cast<double>(total_)) ++bin;
    return step_px * static_cast<double>(bin + 1);
  }

 private:
  std::vector<std::uint64_t> counts_;
  std::uint64_t total_ = 0;
};

}  // namespace

FlowResult flow(const engine::Seq<FlowField>& flow, const engine::Seq<FlowField>& truth) {
  check_frame_counts(flow.size(), truth.size(), "flow", "truth");
  FlowResult result;
  result.frames.columns = {"epe_mean_px", "epe_p95_px", "over_1px_percent", "valid_percent"};
  Histogram histogram;
  double sum = 0, over = 0, known = 0, count = 0;
  for (std::size_t f = 0; f < flow.size(); ++f) {
    const auto own = flow.at(f), real = truth.at(f);
    check_field(*own, "flow", flow.id(f));
    check_field(*real, "truth", truth.id(f));
    check(own->width == real->width && own->height == real->height, "flow of frame ", flow.id(f), " is ", own->width,
          " x ", own->height, ", truth is ", real->width, " x ", real->height);
    std::vector<double> errors;
    double frame_known = 0, frame_over = 0;
    for (std::size_t i = 0; i < real->valid.size(); ++i) {
      if (!real->valid[i]) continue;
      ++frame_known;
      if (!own->valid[i]) continue;
      errors.push_back(std::hypot(double{own->displacement_px[i][0]} - real->displacement_px[i][0],
                                  double{own->displacement_px[i][1]} - real->displacement_px[i][1]));
      histogram.add(errors.back());
      sum += errors.back();
      frame_over += errors.back() > 1 ? 1 : 0;
    }
    const auto frame_count = static_cast<double>(errors.size());
    result.frames.rows.push_back({flow.id(f),
                                  {mean_of(errors), quantile(errors, 0.95), percent_of(frame_over, frame_count),
                                   percent_of(frame_count, frame_known)}});
    over += frame_over, known += frame_known, count += frame_count;
  }
  result.table = one_row(
      "all", result.frames.columns,
      {percent_of(sum, count) / 100, histogram.quantile(0.95), percent_of(over, count), percent_of(count, known)});
  return result;
}

}  // namespace face::evaluate
