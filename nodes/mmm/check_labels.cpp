// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/check_labels.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"

namespace face::mmm {
namespace {

std::string name_of(const Phones& phones, std::size_t i) {
  const Phone& phone = phones.phones[i];
  return message("labels do not match the video: phone ", i, " (", phone.label,
                 phone.word.empty() ? "" : " of \"" + phone.word + "\"", ") is from ", phone.start_s, " s to ",
                 phone.end_s, " s, ");
}

// Sums over the speech from phone `first` on, until it is window_s long.
struct WindowOfSpeech {
  std::vector<std::size_t> phones;
  double time_s = 0, mean_score = 0, median_apart_s = 0;
};

WindowOfSpeech window_from(std::size_t first, const Phones& phones, const Matrix& apart_s, double window_s) {
  WindowOfSpeech window;
  std::vector<double> apart;
  for (std::size_t i = first; i < phones.phones.size() && window.time_s < window_s; ++i) {
    const Phone& phone = phones.phones[i];
    if (phone.label == "SIL") continue;
    window.phones.push_back(i);
    window.time_s += phone.end_s - phone.start_s;
    window.mean_score += phone.score * (phone.end_s - phone.start_s);
    apart.push_back(apart_s.values[i]);
  }
  if (apart.empty()) return window;
  window.mean_score /= window.time_s;
  window.median_apart_s = median(std::move(apart));
  return window;
}

void check_against_sound(const Phones& phones, const Matrix& apart_s, const CheckLabelsOptions& options) {
  const std::vector<Phone>& list = phones.phones;
  check(apart_s.columns == 1 && apart_s.rows == list.size() && apart_s.values.size() == list.size(), "apart_s is ",
        apart_s.rows, " x ", apart_s.columns, ", expected ", list.size(), " x 1, one of each phone");
  bool is_first = true;
  for (std::size_t first = 0; first < list.size(); ++first) {
    if (list[first].label == "SIL") continue;
    const WindowOfSpeech window = window_from(first, phones, apart_s, options.window_s);
    // The end is part of the windows before it; a short clip is less than one.
    if (!is_first && window.time_s < options.window_s) return;
    is_first = false;
    const bool sounds = window.mean_score >= options.match_score, there = window.median_apart_s <= options.most_apart_s;
    if (sounds && there) continue;
    for (const std::size_t i : window.phones) {
      if (!sounds)
        check(list[i].score >= options.match_score, name_of(phones, i), "the sound there scores ", list[i].score,
              " with it, expected ", options.match_score, " or more");
      check(there || apart_s.values[i] <= options.most_apart_s, name_of(phones, i), "the sound has it ",
            apart_s.values[i], " s away, expected ", options.most_apart_s, " s or less");
    }
  }
}

}  // namespace

Phones check_labels(const Phones& phones, const Timeline& timeline, const Matrix* apart_s,
                    const CheckLabelsOptions& options) {
  const double end_s = timeline.duration_s, tolerance_s = options.tolerance_s;
  check(!phones.phones.empty(), "labels do not match the video: there are none, the video lasts ", end_s, " s");
  double at_s = 0;
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    const std::string name = name_of(phones, i);
    check(std::abs(phone.start_s - at_s) <= tolerance_s, name, "the one before it ends at ", at_s, " s");
    check(phone.end_s > phone.start_s, name, "expected an end after its beginning");
    check(phone.end_s <= end_s + tolerance_s, name, "the video ends at ", end_s, " s");
    at_s = phone.end_s;
  }
  const Phone& last = phones.phones.back();
  check(at_s >= end_s - tolerance_s, "labels do not match the video: the last phone (", last.label, ") ends at ", at_s,
        " s, the video ends at ", end_s, " s");
  if (apart_s) check_against_sound(phones, *apart_s, options);
  return phones;
}

}  // namespace face::mmm
