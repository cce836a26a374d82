// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/check_labels.h"

#include <cmath>
#include <string>

#include "nodes/base/check.h"

namespace face::mmm {

Phones check_labels(const Phones& phones, const Timeline& timeline, const CheckLabelsOptions& options) {
  const double end_s = timeline.duration_s, tolerance_s = options.tolerance_s;
  check(!phones.phones.empty(), "labels do not match the video: there are none, the video lasts ", end_s, " s");
  double at_s = 0;
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    const std::string name = message("labels do not match the video: phone ", i, " (", phone.label,
                                     phone.word.empty() ? "" : " of \"" + phone.word + "\"", ") is from ",
                                     phone.start_s, " s to ", phone.end_s, " s, ");
    check(std::abs(phone.start_s - at_s) <= tolerance_s, name, "the one before it ends at ", at_s, " s");
    check(phone.end_s > phone.start_s, name, "expected an end after its beginning");
    check(phone.end_s <= end_s + tolerance_s, name, "the video ends at ", end_s, " s");
    at_s = phone.end_s;
  }
  const Phone& last = phones.phones.back();
  check(at_s >= end_s - tolerance_s, "labels do not match the video: the last phone (", last.label, ") ends at ", at_s,
        " s, the video ends at ", end_s, " s");
  return phones;
}

}  // namespace face::mmm
