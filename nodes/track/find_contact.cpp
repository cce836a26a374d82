// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_contact.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/base/quantile.h"

namespace face::track {
namespace {

double distance_px(const Landmarks& points, const std::string& a, const std::string& b) {
  const Landmark *p = find_landmark(points, a), *q = find_landmark(points, b);
  check(p && q, "there is no landmark ", p ? b : a, ", expected the lips' points and where they part");
  return std::hypot(p->x_px - q->x_px, p->y_px - q->y_px);
}

// Of what is seen of both lips, mean over three lines across the mouth.
double lower_share(const Landmarks& points) {
  double share = 0;
  for (int k = 1; k <= 3; ++k) {
    const auto name = [](const char* kind, int number) { return kind + std::to_string(number); };
    const double upper_px = distance_px(points, name("lip_", k + 1), name("inner_lip_", k));
    const double lower_px = distance_px(points, name("lip_", 11 - k), name("inner_lip_", 8 - k));
    share += lower_px / std::max(1e-9, upper_px + lower_px) / 3;
  }
  return share;
}

}  // namespace

void find_contact(const engine::Seq<double>& openings, const engine::Seq<Landmarks>* landmarks,
                  engine::SeqWriter<double>& contacts, const FindContactOptions& options) {
  check(!landmarks || landmarks->size() == openings.size(), "there are ", landmarks ? landmarks->size() : 0,
        " landmarks, expected ", openings.size(), " as openings");
  check(options.tucked < options.untucked, "tucked is ", options.tucked, ", expected less than untucked, which is ",
        options.untucked);
  check(options.shut_ratio < options.open_ratio, "shut_ratio is ", options.shut_ratio,
        ", expected less than open_ratio, which is ", options.open_ratio);
  std::vector<double> all, seen;
  for (const double opening : openings) {
    check(std::isfinite(opening), "the opening of frame ", openings.id(all.size()), " is ", opening,
          ", expected a finite number");
    all.push_back(opening);
    if (opening >= 0) seen.push_back(opening);
  }
  // Between two frames, so that one frame more changes little.
  const double shut = seen.empty() ? 0 : std::min(options.most_shut, quantile(std::move(seen), options.shut_share));
  std::vector<double> found, shares;
  for (const double opening : all) {
    const double from = options.shut_ratio * (shut + options.seam), to = options.open_ratio * (shut + options.seam);
    found.push_back(opening < 0 || opening >= to ? 0 : opening <= from ? 1 : (to - opening) / (to - from));
  }
  for (std::size_t t = 0; landmarks && t < found.size(); ++t)
    if (found[t] > 0) shares.push_back(lower_share(*landmarks->at(t)));
  const double usual = median(shares);
  std::size_t next = 0;
  for (std::size_t t = 0; t < found.size(); ++t) {
    if (landmarks && found[t] > 0) {
      const double tucked = options.tucked * usual, untucked = options.untucked * usual, share = shares[next++];
      found[t] *= untucked > tucked ? std::clamp((share - tucked) / (untucked - tucked), 0.0, 1.0) : 1;
    }
    contacts.push(openings.id(t), found[t]);
  }
}

}  // namespace face::track
