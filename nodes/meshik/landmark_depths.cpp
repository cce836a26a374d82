// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/landmark_depths.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/head_facing.h"
#include "nodes/meshik/landmark_vertices.h"

namespace face::meshik {
namespace {

using Place = std::complex<double>;
using Places = std::vector<LandmarkVertex>;

Place seen(const Landmarks& neutral, const LandmarkVertex& place) {
  const Landmark& point = neutral.points[place.landmark];
  return {point.x_px, point.y_px};
}

const LandmarkVertex* place_of(const Places& places, int number) {
  const auto at = std::find_if(places.begin(), places.end(), [&](const auto& place) { return place.number == number; });
  return at == places.end() ? nullptr : &*at;
}

// The rig's inner corners of the eyes.
struct Eyes {
  const LandmarkVertex *right, *left;
  double apart_mm, height_mm, depth_mm;  // middle
};

std::optional<Eyes> eyes_of(const Rig& rig, const Places& places) {
  const LandmarkVertex *right = place_of(places, 39), *left = place_of(places, 42);
  if (right == nullptr || left == nullptr) return std::nullopt;
  const Vec3f &a = rig.neutral.points_mm[right->vertex], &b = rig.neutral.points_mm[left->vertex];
  const auto middle = [&](std::size_t k) { return (static_cast<double>(a[k]) + static_cast<double>(b[k])) / 2; };
  return Eyes{right, left, std::abs(static_cast<double>(b[0] - a[0])), middle(1), middle(2)};
}

// How the head of the landmarks is turned, if it is about as the rig; nobody knows without corners of the eyes.
std::optional<HeadFacing> facing_by(const Rig& rig, const Landmarks& neutral, const Places& places,
                                    const std::optional<Eyes>& eyes) {
  if (!eyes || eyes->apart_mm == 0) return std::nullopt;
  const auto below = [&](const LandmarkVertex& place) {
    return (eyes->height_mm - static_cast<double>(rig.neutral.points_mm[place.vertex][1])) / eyes->apart_mm;
  };
  const auto depth = [&](const LandmarkVertex& place) {
    return (static_cast<double>(rig.neutral.points_mm[place.vertex][2]) - eyes->depth_mm) / eyes->apart_mm;
  };
  std::vector<MiddleMark> marks;
  if (const auto* tip = place_of(places, 30))
    marks.push_back(nose_tip_mark(seen(neutral, *tip), below(*tip), depth(*tip)));
  if (const auto* right = place_of(places, 48), *left = place_of(places, 54); right != nullptr && left != nullptr)
    marks.push_back(mouth_mark((seen(neutral, *right) + seen(neutral, *left)) / 2.0, (below(*right) + below(*left)) / 2,
                               (depth(*right) + depth(*left)) / 2));
  if (const auto* chin = place_of(places, 8))
    marks.push_back(chin_mark(seen(neutral, *chin), below(*chin), depth(*chin)));
  return head_facing(seen(neutral, *eyes->right), seen(neutral, *eyes->left), marks);
}

}  // namespace

Matrix landmark_depths(const Rig& rig, const Landmarks& neutral) {
  const std::vector<LandmarkVertex> places = landmark_vertices(rig, neutral);
  for (const LandmarkVertex& place : places)
    check(place.vertex < rig.neutral.points_mm.size(), "a landmark is vertex ", place.vertex, ", expected one below ",
          rig.neutral.points_mm.size());
  const double scale_mm = landmark_scale_mm(rig, neutral, places);
  const std::optional<Eyes> eyes = eyes_of(rig, places);
  const std::optional<HeadFacing> facing = facing_by(rig, neutral, places, eyes);
  const double eyes_depth_px = facing ? eyes->depth_mm / scale_mm : 0;
  const auto depth = [&](const LandmarkVertex& place) {
    const double front_px = static_cast<double>(rig.neutral.points_mm[place.vertex][2]) / scale_mm;
    if (!facing) return front_px;
    return eyes_depth_px + facing->depth_px(seen(neutral, place), front_px - eyes_depth_px);
  };
  double mean = 0;
  for (const LandmarkVertex& place : places) mean += depth(place) / static_cast<double>(places.size());
  Matrix depths{neutral.points.size(), 1, std::vector<double>(neutral.points.size(), mean)};
  for (const LandmarkVertex& place : places) depths.at(place.landmark, 0) = depth(place);
  return depths;
}

}  // namespace face::meshik
