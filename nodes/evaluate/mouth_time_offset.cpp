// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mouth_time_offset.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "nodes/base/check.h"
#include "nodes/base/mouth.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

struct Motion {
  std::vector<double> opening_mm, width_mm;

  void add(const Rig& rig, const std::vector<Vec3f>& points) {
    opening_mm.push_back(lip_gap_mm(rig, points));
    if (rig.landmarks68.size() == 68) {
      width_mm.push_back(std::sqrt(squared_distance(points.at(rig.landmarks68[48]), points.at(rig.landmarks68[54]))));
      return;
    }
    float low = 1e9f, high = -1e9f;
    for (const LipPair& pair : rig.inner_lips)
      for (const std::uint32_t v : {pair.upper, pair.lower})
        low = std::min(low, points[v][0]), high = std::max(high, points[v][0]);
    width_mm.push_back(high - low);
  }
};

double refined_time(const std::vector<double>& v, const std::vector<double>& t, std::size_t i) {
  if (i == 0 || i + 1 >= v.size()) return t[i];
  const double left = (v[i] - v[i - 1]) / (t[i] - t[i - 1]), right = (v[i + 1] - v[i]) / (t[i + 1] - t[i]);
  if (left == right) return t[i];
  // Where the slope, linear between the middles of the two intervals, is 0.
  const double a = (t[i - 1] + t[i]) / 2, b = (t[i] + t[i + 1]) / 2;
  return std::clamp(a + (b - a) * left / (left - right), t[i - 1], t[i + 1]);
}

struct Offsets {
  std::vector<double> ms;
  std::size_t own = 0, true_count = 0;

  void add(const Offsets& other) {
    ms.insert(ms.end(), other.ms.begin(), other.ms.end());
    own += other.own;
    true_count += other.true_count;
  }
  TableRow row(const char* name) const {
    std::vector<double> sizes = ms;
    for (double& value : sizes) value = std::abs(value);
    const auto matched = static_cast<double>(ms.size());
    return {name,
            {mean_of(sizes), mean_of(ms), matched,
             percent_of(static_cast<double>(true_count) - matched, static_cast<double>(true_count)),
             percent_of(static_cast<double>(own) - matched, static_cast<double>(own))}};
  }
};

// Leaving both of a pair out costs more than any allowed offset, so that as many as possible are matched.
Offsets match(const std::vector<Extremum>& own, const std::vector<Extremum>& truth, double max_offset_ms) {
  const std::size_t n = own.size(), m = truth.size();
  const double skip = max_offset_ms;
  std::vector<double> cost((n + 1) * (m + 1));
  const auto at = [m](std::size_t i, std::size_t j) { return i * (m + 1) + j; };
  const auto pair_cost = [&](std::size_t i, std::size_t j) {
    const double offset = 1000 * std::abs(own[i].time_s - truth[j].time_s);
    return own[i].peak == truth[j].peak && offset <= max_offset_ms ? offset : 3 * skip;
  };
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= m; ++j) {
      double best = i + j == 0 ? 0 : 1e300;
      if (i > 0) best = std::min(best, cost[at(i - 1, j)] + skip);
      if (j > 0) best = std::min(best, cost[at(i, j - 1)] + skip);
      if (i > 0 && j > 0) best = std::min(best, cost[at(i - 1, j - 1)] + pair_cost(i - 1, j - 1));
      cost[at(i, j)] = best;
    }
  Offsets offsets;
  offsets.own = n;
  offsets.true_count = m;
  for (std::size_t i = n, j = m; i > 0 && j > 0;) {
    if (cost[at(i, j)] == cost[at(i - 1, j - 1)] + pair_cost(i - 1, j - 1)) {
      --i, --j;
      offsets.ms.push_back(1000 * (own[i].time_s - truth[j].time_s));
    } else if (cost[at(i, j)] == cost[at(i - 1, j)] + skip) {
      --i;
    } else {
      --j;
    }
  }
  return offsets;
}

}  // namespace

std::vector<Extremum> find_extrema(const std::vector<double>& values, const std::vector<double>& time_s,
                                   double prominence) {
  check(values.size() == time_s.size(), "the curve has ", values.size(), " values, ", time_s.size(), " times");
  std::vector<Extremum> found;
  std::size_t low = 0, high = 0;
  int direction = 0;  // 1: rising, looking for a peak; -1: falling; 0: not known yet
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[high]) high = i;
    if (values[i] < values[low]) low = i;
    if (direction >= 0 && values[high] - values[i] >= prominence) {
      if (direction == 1 || high > 0) found.push_back({refined_time(values, time_s, high), true});
      direction = -1;
      low = high = i;
    } else if (direction <= 0 && values[i] - values[low] >= prominence) {
      if (direction == -1 || low > 0) found.push_back({refined_time(values, time_s, low), false});
      direction = 1;
      low = high = i;
    }
  }
  return found;
}

Table mouth_time_offset(const Rig& rig, const engine::Seq<Weights>& weights, const engine::Seq<Weights>& truth,
                        const Timeline& timeline, const MouthTimeOffsetOptions& options) {
  check_times(weights.size(), timeline, "weights");
  Motion own, true_motion;
  for_each_pose(rig, weights, truth, [&](std::size_t, const auto& points, const auto& true_points) {
    own.add(rig, points);
    true_motion.add(rig, true_points);
  });
  const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b) {
    return match(find_extrema(a, timeline.time_s, options.prominence_mm),
                 find_extrema(b, timeline.time_s, options.prominence_mm), options.max_offset_ms);
  };
  Offsets opening = compare(own.opening_mm, true_motion.opening_mm);
  const Offsets width = compare(own.width_mm, true_motion.width_mm);
  Table table;
  table.columns = {"offset_ms", "late_ms", "matched", "missing_percent", "extra_percent"};
  table.rows = {opening.row("opening"), width.row("width")};
  opening.add(width);
  table.rows.push_back(opening.row("both"));
  return table;
}

}  // namespace face::evaluate
