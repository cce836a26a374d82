// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/join_takes.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"

namespace face::model {

JoinTakesResult join_takes(const engine::Seq<Phones>& phones, const engine::Seq<Timeline>& timelines,
                           engine::Progress& progress) {
  check(phones.size() == timelines.size(), "phones has ", phones.size(), " takes, timelines ", timelines.size());
  for (std::size_t t = 0; t < phones.size(); ++t)
    check(phones.id(t) == timelines.id(t), "phones has take ", phones.id(t), " at ", t, ", timelines take ",
          timelines.id(t));
  JoinTakesResult result;
  double start_s = 0;
  for (std::size_t t = 0; t < phones.size(); ++t) {
    const auto speech = phones.at(t);
    const auto frames = timelines.at(t);
    const double length_s = std::max(speech->duration_s, frames->duration_s);
    if (std::fabs(speech->duration_s - frames->duration_s) > 0.5)
      progress.warn(message("take ", phones.id(t), ": its speech lasts ", speech->duration_s, " s, its frames ",
                            frames->duration_s,
                            " s, expected the same: is the sound that of this take, and rate_hz right?"));
    for (Phone phone : speech->phones) {
      phone.start_s += start_s;
      phone.end_s += start_s;
      result.phones.phones.push_back(phone);
    }
    if (length_s > speech->duration_s)
      result.phones.phones.push_back({"SIL", start_s + speech->duration_s, start_s + length_s, "", 0});
    for (const double time_s : frames->time_s) result.timeline.time_s.push_back(start_s + time_s);
    result.phones.confident = result.phones.confident && speech->confident;
    start_s += length_s;
  }
  result.phones.duration_s = result.timeline.duration_s = start_s;
  return result;
}

}  // namespace face::model
