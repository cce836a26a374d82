// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/phone_boundaries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

struct Segment {
  std::string label;
  double start_s = 0, end_s = 0;
  double middle_s() const { return (start_s + end_s) / 2; }
};

std::string base_of(const std::string& label) { return label.substr(0, label.find('.')); }
bool is_half(const std::string& label) { return label.find('.') != std::string::npos; }
bool is_stop(const std::string& label) {
  const std::string base = base_of(label);
  for (const char* stop : {"P", "B", "T", "D", "K", "G"})
    if (base == stop) return true;
  return false;
}

bool splits_all_stops(const Phones& phones) {
  return std::all_of(phones.phones.begin(), phones.phones.end(),
                     [](const Phone& phone) { return !is_stop(phone.label) || is_half(phone.label); });
}

std::vector<Segment> segments_of(const Phones& phones, bool whole_stops, const char* name) {
  check(!phones.phones.empty(), name, " has no phones to judge");
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    check(std::isfinite(phone.start_s) && std::isfinite(phone.end_s) && phone.end_s >= phone.start_s, name, ": phone ",
          i, " (", phone.label, ") lasts from ", phone.start_s, " to ", phone.end_s,
          " s, expected an ascending finite pair");
    const bool release = whole_stops && phone.label.ends_with(".r");
    if (release && !segments.empty() && phones.phones[i - 1].label == base_of(phone.label) + ".c")
      segments.back().end_s = phone.end_s;
    else
      segments.push_back({whole_stops ? base_of(phone.label) : phone.label, phone.start_s, phone.end_s});
  }
  return segments;
}

struct Matching {
  std::vector<std::ptrdiff_t> own_of_true;  // -1 where there is none, or another phone
  double errors = 0;                        // among phones other than silence
  double wanted = 0;
};

Matching match(const std::vector<Segment>& own, const std::vector<Segment>& truth) {
  // Distances of middles decide between equal numbers of edits only: all of them together weigh less than one edit.
  const std::size_t n = own.size(), m = truth.size();
  const double longest_s = std::max({1.0, own.back().end_s, truth.back().end_s});
  const double weight = 0.5 / (longest_s * static_cast<double>(n + m));
  const auto at = [m](std::size_t i, std::size_t j) { return i * (m + 1) + j; };
  const auto pair_cost = [&](std::size_t i, std::size_t j) {
    return (own[i].label == truth[j].label ? 0.0 : 1.0) + weight * std::abs(own[i].middle_s() - truth[j].middle_s());
  };
  std::vector<double> cost((n + 1) * (m + 1));
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= m; ++j) {
      double best = i + j == 0 ? 0 : std::numeric_limits<double>::infinity();
      if (i > 0) best = std::min(best, cost[at(i - 1, j)] + 1);
      if (j > 0) best = std::min(best, cost[at(i, j - 1)] + 1);
      if (i > 0 && j > 0) best = std::min(best, cost[at(i - 1, j - 1)] + pair_cost(i - 1, j - 1));
      cost[at(i, j)] = best;
    }
  Matching matching;
  matching.own_of_true.assign(m, -1);
  const auto spoken = [](const Segment& segment) { return segment.label == "SIL" ? 0.0 : 1.0; };
  for (const Segment& segment : truth) matching.wanted += spoken(segment);
  for (std::size_t i = n, j = m; i > 0 || j > 0;) {
    if (i > 0 && j > 0 && cost[at(i, j)] == cost[at(i - 1, j - 1)] + pair_cost(i - 1, j - 1)) {
      --i, --j;
      if (own[i].label == truth[j].label)
        matching.own_of_true[j] = static_cast<std::ptrdiff_t>(i);
      else
        matching.errors += std::max(spoken(own[i]), spoken(truth[j]));
    } else if (i > 0 && cost[at(i, j)] == cost[at(i - 1, j)] + 1) {
      matching.errors += spoken(own[--i]);
    } else {
      matching.errors += spoken(truth[--j]);
    }
  }
  return matching;
}

// Of two ascending lists of times, how many pairs lie within a tolerance, each used once. Taking the earliest that fits
// is best.
double hits_within(const std::vector<Segment>& own, const std::vector<Segment>& truth, double tolerance_s) {
  double hits = 0;
  for (std::size_t i = 1, j = 1; i < own.size() && j < truth.size();) {
    const double difference = own[i].start_s - truth[j].start_s;
    if (std::abs(difference) <= tolerance_s)
      ++hits, ++i, ++j;
    else if (difference < 0)
      ++i;
    else
      ++j;
  }
  return hits;
}

}  // namespace

Table phone_boundaries(const Phones& phones, const Phones& truth) {
  const bool whole_stops = !splits_all_stops(phones) || !splits_all_stops(truth);
  const std::vector<Segment> own = segments_of(phones, whole_stops, "phones");
  const std::vector<Segment> true_ones = segments_of(truth, whole_stops, "truth");
  const Matching matching = match(own, true_ones);
  std::vector<double> late_ms, sizes_ms;
  for (std::size_t j = 1; j < true_ones.size(); ++j) {
    const std::ptrdiff_t before = matching.own_of_true[j - 1], after = matching.own_of_true[j];
    if (before < 0 || after != before + 1) continue;
    late_ms.push_back(1000 * (own[static_cast<std::size_t>(after)].start_s - true_ones[j].start_s));
    sizes_ms.push_back(std::abs(late_ms.back()));
  }
  constexpr double rounding_ms = 1e-6;  // times that are 20 ms apart in decimals are not in binary
  const auto own_count = static_cast<double>(own.size() - 1), true_count = static_cast<double>(true_ones.size() - 1);
  const double hits = hits_within(own, true_ones, 0.02 + rounding_ms / 1000);
  const double hit_rate = percent_of(hits, true_count) / 100, over = own_count / true_count - 1;
  const double r1 = std::hypot(1 - hit_rate, over), r2 = (hit_rate - 1 - over) / std::numbers::sqrt2;
  return one_row(
      "all",
      {"boundaries", "mae_ms", "median_ms", "bias_ms", "within_10ms_percent", "within_20ms_percent",
       "within_25ms_percent", "within_50ms_percent", "unmatched_percent", "per_percent", "f1_20ms_percent", "r_value"},
      {static_cast<double>(late_ms.size()), mean_of(sizes_ms), quantile(sizes_ms, 0.5), mean_of(late_ms),
       percent_within(sizes_ms, 10 + rounding_ms), percent_within(sizes_ms, 20 + rounding_ms),
       percent_within(sizes_ms, 25 + rounding_ms), percent_within(sizes_ms, 50 + rounding_ms),
       percent_of(true_count - static_cast<double>(late_ms.size()), true_count),
       percent_of(matching.errors, matching.wanted), percent_of(2 * hits, own_count + true_count),
       1 - (std::abs(r1) + std::abs(r2)) / 2});
}

}  // namespace face::evaluate
