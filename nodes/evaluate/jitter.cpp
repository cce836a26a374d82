// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/jitter.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <opencv2/core.hpp>

#include "nodes/base/check.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/regions.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_vertices = 100;

std::vector<std::uint32_t> some_of(const std::vector<std::uint32_t>& all) {
  if (all.size() <= most_vertices) return all;
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < most_vertices; ++i) some.push_back(all[i * all.size() / most_vertices]);
  return some;
}

// Curves of every coordinate: 3 per vertex, T each.
std::vector<std::vector<double>> curves_of(const engine::Seq<MeshPoints>& points,
                                           const std::vector<std::uint32_t>& vertices, std::size_t vertex_count,
                                           const char* name) {
  std::vector<std::vector<double>> curves(3 * vertices.size());
  std::size_t frame = 0;
  for (const MeshPoints& pose : points) {
    check_points(pose, vertex_count, name, points.id(frame++));
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) curves[3 * i + c].push_back(pose.points_mm[vertices[i]][c]);
  }
  return curves;
}

std::vector<double> measures_of(const std::vector<std::vector<double>>& curves, double rate_hz, double cut_hz) {
  std::vector<double> spread, jerk;
  for (const std::vector<double>& x : curves) {
    spread.push_back(deviation_of(x));
    std::vector<double> second;
    for (std::size_t t = 1; t + 1 < x.size(); ++t) second.push_back(x[t + 1] - 2 * x[t] + x[t - 1]);
    if (!second.empty()) jerk.push_back(rms_of(second));
  }
  // Of the three coordinates of a vertex the squares add up.
  const double root3 = std::sqrt(3.0);
  return {root3 * rms_of(spread), root3 * rms_of(jerk), high_power_percent(curves, rate_hz, cut_hz)};
}

}  // namespace

double high_power_percent(const std::vector<std::vector<double>>& curves, double rate_hz, double cut_hz) {
  double high = 0, whole = 0;
  for (const std::vector<double>& curve : curves) {
    if (curve.size() < 3) continue;
    const double mean = mean_of(curve), frames = static_cast<double>(curve.size());
    cv::Mat row(1, static_cast<int>(curve.size()), CV_64F), spectrum;
    for (int t = 0; t < row.cols; ++t) {
      const double window = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (t + 0.5) / frames);
      row.at<double>(0, t) = window * (curve[static_cast<std::size_t>(t)] - mean);
    }
    cv::dft(row, spectrum, cv::DFT_COMPLEX_OUTPUT);
    for (int k = 1; k <= row.cols / 2; ++k) {
      const auto& value = spectrum.at<cv::Vec2d>(0, k);
      const double power = value[0] * value[0] + value[1] * value[1];
      whole += power;
      if (k * rate_hz / frames > cut_hz) high += power;
    }
  }
  return percent_of(high, whole);
}

Table jitter(const engine::Seq<MeshPoints>& points, const engine::Seq<MeshPoints>* truth, const Timeline& timeline,
             const Rig* rig, const VertexMask* vertices, const JitterOptions& options) {
  check_frame_counts(points.size(), truth ? truth->size() : points.size(), "points", "truth");
  check_times(points.size(), timeline, "points");
  const std::size_t count = points.at(0)->points_mm.size();
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  if (rig && rig->landmarks68.size() == 68) {
    check(rig->neutral.points_mm.size() == count, "points of frame ", points.id(0), " has ", count,
          " vertices, the rig has ", rig->neutral.points_mm.size());
    all = rig->landmarks68;
    for (const std::uint32_t v : all)
      check(v < count, "landmark vertex ", v, " is outside the rig's ", count, " vertices");
  }
  const std::vector<std::uint32_t> chosen = some_of(chosen_vertices(vertices, count, "vertices", all));
  const double length_s = timeline.time_s.back() - timeline.time_s.front();
  const double rate_hz = length_s > 0 ? static_cast<double>(points.size() - 1) / length_s : nothing;
  Table table;
  table.columns = {"spread_mm", "jerk_mm", "high_percent"};
  table.rows.push_back({"own", measures_of(curves_of(points, chosen, count, "points"), rate_hz, options.cut_hz)});
  if (truth) {
    table.rows.push_back({"truth", measures_of(curves_of(*truth, chosen, count, "truth"), rate_hz, options.cut_hz)});
    std::vector<double> ratio;
    for (std::size_t i = 0; i < 3; ++i)
      ratio.push_back(percent_of(table.rows[0].values[i], table.rows[1].values[i]) / 100);
    table.rows.push_back({"ratio", ratio});
  }
  return table;
}

}  // namespace face::evaluate
