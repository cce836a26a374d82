// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/lip_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/mouth.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

struct Span {
  double start_s = 0, end_s = 0;
  double middle_s() const { return (start_s + end_s) / 2; }
};

struct Events {
  std::vector<Span> bilabials, labiodentals, open_vowels;
};

template <std::size_t N>
bool is_one_of(const std::string& label, const std::array<const char*, N>& labels) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

Events events_of(const Phones& phones, const Timeline& timeline) {
  constexpr std::array bilabials = {"P", "B", "M", "P.c", "B.c"};
  constexpr std::array labiodentals = {"F", "V"};
  constexpr std::array open_vowels = {"AA", "AE", "AO", "AW", "AY", "EH"};
  Events events;
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    check(std::isfinite(phone.start_s) && std::isfinite(phone.end_s) && phone.end_s >= phone.start_s, "phone ", i, " (",
          phone.label, ") lasts from ", phone.start_s, " to ", phone.end_s, " s, expected an ascending finite pair");
    if (phone.start_s < timeline.time_s.front() || phone.end_s > timeline.time_s.back()) continue;
    const Span span{phone.start_s, phone.end_s};
    if (is_one_of(phone.label, bilabials)) events.bilabials.push_back(span);
    if (is_one_of(phone.label, labiodentals)) events.labiodentals.push_back(span);
    if (is_one_of(phone.label, open_vowels)) events.open_vowels.push_back(span);
  }
  return events;
}

double value_at(const std::vector<double>& times, const std::vector<double>& values, double time_s) {
  const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
  if (after == 0) return values.front();
  if (after == times.size()) return values.back();
  const double t = (time_s - times[after - 1]) / (times[after] - times[after - 1]);
  return values[after - 1] + t * (values[after] - values[after - 1]);
}

struct Least {
  double value = 0, time_s = 0;
};

// The least value of a curve that is linear between its samples, and the middle of the times at which it is reached (to
// a hundredth of a mm: frames of a held closure are equal to rounding only).
Least least_within(const std::vector<double>& times, const std::vector<double>& values, const Span& span) {
  std::vector<std::pair<double, double>> samples = {{span.start_s, value_at(times, values, span.start_s)}};
  for (auto i = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), span.start_s) - times.begin());
       i < times.size() && times[i] < span.end_s; ++i)
    samples.push_back({times[i], values[i]});
  samples.push_back({span.end_s, value_at(times, values, span.end_s)});
  Least least{samples[0].second, 0};
  for (const auto& sample : samples) least.value = std::min(least.value, sample.second);
  double first_s = span.end_s, last_s = span.start_s;
  for (const auto& [time_s, value] : samples)
    if (value <= least.value + 0.01) first_s = std::min(first_s, time_s), last_s = std::max(last_s, time_s);
  least.time_s = (first_s + last_s) / 2;
  return least;
}

struct Judged {
  std::vector<double> gaps_mm;
  TableRow row;
};

class Judge {
 public:
  Judge(const Rig& rig, const Phones& phones, const Timeline& timeline, double closed_mm)
      : rig_(rig), times_(timeline.time_s), events_(events_of(phones, timeline)), teeth_(rig), closed_mm_(closed_mm) {}

  Judged look_at(const engine::Seq<Weights>& weights, const char* name) const {
    Judged judged;
    std::vector<double> teeth_mm(weights.size(), std::numeric_limits<double>::quiet_NaN());
    const std::vector<bool> wanted = frames_of_labiodentals();
    std::size_t frame = 0;
    for (const Weights& pose : weights) {
      judged.gaps_mm.push_back(lip_gap_mm(rig_, posed(rig_, pose, name, weights.id(frame))));
      if (teeth_.usable() && wanted[frame]) teeth_mm[frame] = teeth_.nearest(pose.values).distance_mm;
      ++frame;
    }
    std::vector<double> excess, late_ms, offset_ms, into, vowels, contacts, contact_excess;
    double closed = 0;
    for (const Span& span : events_.bilabials) {
      const Least least = least_within(times_, judged.gaps_mm, span);
      closed += least.value <= closed_mm_ ? 1 : 0;
      excess.push_back(std::max(0.0, least.value - closed_mm_));
      late_ms.push_back(1000 * (least.time_s - span.middle_s()));
      offset_ms.push_back(std::abs(late_ms.back()));
    }
    for (const double gap : judged.gaps_mm) into.push_back(std::max(0.0, -gap));
    for (const Span& span : events_.open_vowels) vowels.push_back(value_at(times_, judged.gaps_mm, span.middle_s()));
    for (const Span& span : events_.labiodentals) {
      if (!teeth_.usable()) break;
      double least = std::numeric_limits<double>::infinity();
      for (const std::size_t i : frames_of(span)) least = std::min(least, teeth_mm[i]);
      contacts.push_back(least);
      contact_excess.push_back(std::max(0.0, least - closed_mm_));
    }
    const auto count = [](const auto& list) { return static_cast<double>(list.size()); };
    judged.row.values = {count(events_.bilabials),
                         percent_of(closed, count(events_.bilabials)),
                         mean_of(excess),
                         mean_of(late_ms),
                         mean_of(offset_ms),
                         mean_of(into),
                         largest_of(into),
                         count(events_.open_vowels),
                         percent_within(vowels, closed_mm_),
                         count(events_.labiodentals),
                         percent_within(contacts, closed_mm_),
                         mean_of(contact_excess)};
    return judged;
  }

 private:
  std::vector<std::size_t> frames_of(const Span& span) const {
    std::vector<std::size_t> frames;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      if (times_[i] >= span.start_s && times_[i] < span.end_s) frames.push_back(i);
      if (std::abs(times_[i] - span.middle_s()) < std::abs(times_[nearest] - span.middle_s())) nearest = i;
    }
    if (frames.empty()) frames.push_back(nearest);
    return frames;
  }
  std::vector<bool> frames_of_labiodentals() const {
    std::vector<bool> wanted(times_.size(), false);
    for (const Span& span : events_.labiodentals)
      for (const std::size_t i : frames_of(span)) wanted[i] = true;
    return wanted;
  }

  const Rig& rig_;
  std::vector<double> times_;
  Events events_;
  LipTeeth teeth_;
  double closed_mm_;
};

}  // namespace

LipGapResult lip_gap(const Rig& rig, const engine::Seq<Weights>& weights, const engine::Seq<Weights>* truth,
                     const Phones& phones, const Timeline& timeline, const LipGapOptions& options) {
  check_frame_counts(weights.size(), truth ? truth->size() : weights.size(), "weights", "truth");
  check_times(weights.size(), timeline, "weights");
  const Judge judge(rig, phones, timeline, options.closed_mm);
  LipGapResult result;
  result.table.columns = {
      "closures",        "closure_percent",  "closure_error_mm", "closure_late_ms",      "closure_offset_ms",
      "penetration_mm",  "deepest_mm",       "open_vowels",      "false_closed_percent", "labiodentals",
      "contact_percent", "contact_error_mm", "gap_error_mm"};
  result.frames.columns = {"own_gap_mm"};
  Judged own = judge.look_at(weights, "weights");
  for (std::size_t i = 0; i < weights.size(); ++i) result.frames.rows.push_back({weights.id(i), {own.gaps_mm[i]}});
  own.row.name = "own";
  double gap_error_mm = std::numeric_limits<double>::quiet_NaN();
  if (truth) {
    Judged true_one = judge.look_at(*truth, "truth");
    std::vector<double> differences;
    for (std::size_t i = 0; i < weights.size(); ++i) differences.push_back(own.gaps_mm[i] - true_one.gaps_mm[i]);
    gap_error_mm = rms_of(differences);
    result.frames.columns.push_back("truth_gap_mm");
    for (std::size_t i = 0; i < weights.size(); ++i) result.frames.rows[i].values.push_back(true_one.gaps_mm[i]);
    true_one.row.name = "truth";
    true_one.row.values.push_back(0);
    result.table.rows.push_back(std::move(true_one.row));
  }
  own.row.values.push_back(gap_error_mm);
  result.table.rows.insert(result.table.rows.begin(), std::move(own.row));
  return result;
}

}  // namespace face::evaluate
