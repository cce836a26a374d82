// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_rest.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"

namespace face::track {
namespace {

// Outer lips by the layout of 18 and by the 68 of Multi-PIE: lip_0 is 48.
std::string number_of(int lip) { return std::to_string(48 + lip); }

bool is_lip(const Landmark& point) {
  return point.name.starts_with("lip_") ||
         (point.name.size() == 2 && point.name >= number_of(0) && point.name <= number_of(11));
}

double y_of(const Landmarks& landmarks, int lip) {
  const std::string name = "lip_" + std::to_string(lip);
  for (const std::string& either : {name, number_of(lip)})
    if (const Landmark* point = find_landmark(landmarks, either)) return point->y_px;
  fail("there is no point ", name, ", expected lip_1 to lip_5 and lip_7 to lip_11");
}

double lip_height(const Landmarks& landmarks) {
  double height = 0;
  for (int i = 1; i <= 5; ++i) height += (y_of(landmarks, 12 - i) - y_of(landmarks, i)) / 5;
  return height;
}

// The points above and below the opening of the mouth: inner_lip_1 and inner_lip_7, _2 and _6, _3 and _5.
std::vector<std::pair<std::size_t, std::size_t>> inner_pairs(const Landmarks& landmarks) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (int k = 1; k <= 3; ++k) {
    const std::size_t upper = landmark_index(landmarks, "inner_lip_" + std::to_string(k));
    const std::size_t lower = landmark_index(landmarks, "inner_lip_" + std::to_string(8 - k));
    if (std::max(upper, lower) < landmarks.points.size()) pairs.emplace_back(upper, lower);
  }
  return pairs;
}

// A frame whose lips are all seen.
struct Mouth {
  std::size_t frame = 0;
  double height_px = 0;
  std::vector<double> lips_px = {};  // x, y of each
  std::vector<double> gaps_px = {};  // of each of inner_pairs
  double speed_px = 0;
};

double distance_px(const Mouth& a, const Mouth& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.lips_px.size(); ++i) sum += std::pow(a.lips_px[i] - b.lips_px[i], 2);
  return std::sqrt(2 * sum / static_cast<double>(std::max<std::size_t>(1, a.lips_px.size())));
}

std::vector<Mouth> find_mouths(const engine::Seq<Landmarks>& landmarks) {
  std::vector<Mouth> mouths;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const auto here = landmarks.at(i);
    Mouth mouth{i, lip_height(*here)};
    bool seen = true;
    for (const Landmark& point : here->points) {
      if (!is_lip(point)) continue;
      seen = seen && point.valid;
      mouth.lips_px.push_back(point.x_px);
      mouth.lips_px.push_back(point.y_px);
    }
    for (const auto& [upper, lower] : inner_pairs(*here))
      mouth.gaps_px.push_back(here->points[lower].y_px - here->points[upper].y_px);
    if (seen) mouths.push_back(std::move(mouth));
  }
  for (std::size_t i = 0; i < mouths.size(); ++i) {
    constexpr std::size_t reach = 2;
    double sum = 0, count = 0;
    for (std::size_t j = i < reach ? 0 : i - reach; j <= std::min(i + reach, mouths.size() - 1); ++j) {
      const std::size_t apart = std::max(mouths[i].frame, mouths[j].frame) - std::min(mouths[i].frame, mouths[j].frame);
      if (i == j || apart > reach || mouths[i].lips_px.size() != mouths[j].lips_px.size()) continue;
      sum += distance_px(mouths[i], mouths[j]);
      ++count;
    }
    mouths[i].speed_px = count > 0 ? sum / count : 1e9;
  }
  return mouths;
}

// How far each of the pairs is apart in the frames in which the lips meet.
std::vector<double> shut_gaps_px(const std::vector<Mouth>& mouths, std::size_t pairs) {
  constexpr double meeting = 0.1;  // share of the frames
  std::vector<double> shut;
  for (std::size_t k = 0; k < pairs; ++k) {
    std::vector<double> gaps_px;
    for (const Mouth& mouth : mouths)
      if (k < mouth.gaps_px.size()) gaps_px.push_back(mouth.gaps_px[k]);
    const auto place = gaps_px.begin() + static_cast<std::ptrdiff_t>(meeting * static_cast<double>(gaps_px.size() - 1));
    std::nth_element(gaps_px.begin(), place, gaps_px.end());
    shut.push_back(*place);
  }
  return shut;
}

}  // namespace

Landmarks find_rest(const engine::Seq<Landmarks>& landmarks, const FindRestOptions& options) {
  check(!landmarks.empty(), "there are no frames");
  check(options.from_share >= 0 && options.from_share <= options.to_share && options.to_share <= 1,
        "from_share and to_share are ", options.from_share, " and ", options.to_share,
        ", expected two of 0 to 1 in this order");
  std::vector<Mouth> mouths = find_mouths(landmarks);
  Landmarks rest = *landmarks.at(mouths.empty() ? 0 : mouths[0].frame);
  if (mouths.empty()) return rest;
  const auto pairs = inner_pairs(rest);
  const std::vector<double> shut_px = shut_gaps_px(mouths, pairs.size());
  std::stable_sort(mouths.begin(), mouths.end(),
                   [](const Mouth& a, const Mouth& b) { return a.height_px < b.height_px; });
  const auto last = static_cast<double>(mouths.size() - 1);
  const auto begin = static_cast<std::size_t>(options.from_share * last + 0.5);
  const auto end = static_cast<std::size_t>(options.to_share * last + 0.5) + 1;
  const auto kept = std::max<std::size_t>(
      1, static_cast<std::size_t>(options.still_share * static_cast<double>(mouths.size()) + 0.5));
  mouths = {mouths.begin() + static_cast<std::ptrdiff_t>(begin), mouths.begin() + static_cast<std::ptrdiff_t>(end)};
  std::stable_sort(mouths.begin(), mouths.end(),
                   [](const Mouth& a, const Mouth& b) { return a.speed_px < b.speed_px; });
  if (mouths.size() > kept) mouths.resize(kept);

  struct Sum {
    double x_px = 0, y_px = 0, count = 0;
  };
  std::vector<Sum> seen(rest.points.size()), all(rest.points.size());
  for (const Mouth& mouth : mouths) {
    const auto here = landmarks.at(mouth.frame);
    check(here->points.size() == rest.points.size(), "frame ", landmarks.id(mouth.frame), " has ", here->points.size(),
          " points, expected ", rest.points.size());
    for (std::size_t p = 0; p < rest.points.size(); ++p) {
      const Landmark& point = here->points[p];
      for (std::vector<Sum>* sums : {&seen, &all}) {
        if (sums == &seen && !point.valid) continue;
        (*sums)[p].x_px += point.x_px;
        (*sums)[p].y_px += point.y_px;
        ++(*sums)[p].count;
      }
    }
  }
  for (std::size_t p = 0; p < rest.points.size(); ++p) {
    const Sum& sum = seen[p].count > 0 ? seen[p] : all[p];
    rest.points[p].x_px = sum.x_px / sum.count;
    rest.points[p].y_px = sum.y_px / sum.count;
  }
  // A mouth at rest may be a little open; on the head it is shut.
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    double &above = rest.points[pairs[k].first].y_px, &below = rest.points[pairs[k].second].y_px;
    const double more = std::max(0.0, below - above - shut_px[k]) / 2;
    above += more;
    below -= more;
  }
  return rest;
}

}  // namespace face::track
