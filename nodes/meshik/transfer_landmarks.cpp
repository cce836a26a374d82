// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/transfer_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/meshik/landmark_vertices.h"

namespace face::meshik {
namespace {

// A gap up to this is seen better than the lips' outer edges tell it; in wide ones a tongue is taken for lip.
constexpr double clear_gap_mm = 4;

// Corners of the mouth, and those at rest, are seen about as well as this: where a key mesh is nearer to them, it knows
// better.
constexpr double width_error_mm = 1;

VertexTarget at_rest(const Rig& rig, std::uint32_t vertex) {
  const Vec3f& rest = rig.neutral.points_mm[vertex];
  return {vertex, static_cast<double>(rest[0]), static_cast<double>(rest[1]), 0, false};
}

// How far targets of a key mesh are from rest, in front.
using Offsets = std::vector<std::array<double, 2>>;

Offsets offsets_of(const Rig& rig, const Mesh& key, const std::vector<VertexTarget>& targets) {
  Offsets offsets;
  for (const VertexTarget& target : targets) {
    const Vec3f &rest = rig.neutral.points_mm[target.vertex], &posed = key.points_mm[target.vertex];
    offsets.push_back({static_cast<double>(posed[0] - rest[0]), static_cast<double>(posed[1] - rest[1])});
  }
  return offsets;
}

// Takes two lips apart, each half of the way.
void part(double& above_mm, double& below_mm, double by_mm) {
  above_mm += by_mm / 2;
  below_mm -= by_mm / 2;
}

// How far the speaker's inner lips, and the corners of the mouth, are apart in the key shapes, beyond rest.
class SeenMouth {
 public:
  SeenMouth(const Rig& rig, const KeyShapes& key_shapes, const std::vector<LandmarkVertex>& places,
            const Landmarks& neutral)
      : key_shapes_(key_shapes), neutral_(neutral), mm_per_px_(landmark_scale_mm(rig, neutral, places)) {
    constexpr int right_corner = 48, left_corner = 54, last_lip = 67;
    const auto place_of = [&](int number) {
      return std::find_if(places.begin(), places.end(), [&](const LandmarkVertex& p) { return p.number == number; });
    };
    const auto right = place_of(right_corner), left = place_of(left_corner);
    if (right != places.end() && left != places.end()) {
      const auto x_mm = [&](const LandmarkVertex& p) {
        return static_cast<double>(rig.neutral.points_mm[p.vertex][0]);
      };
      corners_ = Pair{static_cast<std::size_t>(right - places.begin()), static_cast<std::size_t>(left - places.begin()),
                      right->landmark, left->landmark};
      const double middle_mm = (x_mm(*right) + x_mm(*left)) / 2, width_mm = x_mm(*left) - x_mm(*right);
      for (const LandmarkVertex& place : places)
        across_.push_back(place.number >= right_corner && place.number <= last_lip && width_mm > 0
                              ? std::clamp((x_mm(place) - middle_mm) / width_mm, -0.5, 0.5)
                              : 0);
    }
    for (std::size_t above = 0; above < places.size(); ++above)
      for (std::size_t below = 0; below < places.size(); ++below)
        if (places[above].number >= 61 && places[above].number <= 63 &&
            places[below].number == 128 - places[above].number)
          pairs_.push_back({above, below, places[above].landmark, places[below].landmark});
  }

  // The offsets of key mesh k with a mouth as wide as is seen, and lips that are as far apart as is seen, as far as
  // that is to be trusted, each going half of the way.
  void apply(std::size_t k, Offsets& offsets) const {
    if (corners_) {
      const Landmarks& seen = key_shapes_.shapes[k].landmarks;
      const double wider_mm = mm_per_px_ * (width_px(seen) - width_px(neutral_)) -
                              (offsets[corners_->second][0] - offsets[corners_->first][0]);
      const double sure = wider_mm * wider_mm / (wider_mm * wider_mm + width_error_mm * width_error_mm);
      for (std::size_t i = 0; i < across_.size(); ++i) offsets[i][0] += across_[i] * sure * wider_mm;
    }
    for (const Pair& pair : pairs_) {
      const double seen_mm = mm_per_px_ * (gap_px(key_shapes_.shapes[k].landmarks, pair) - gap_px(neutral_, pair));
      double &above = offsets[pair.first][1], &below = offsets[pair.second][1];
      const double share = 1 / (1 + std::pow(seen_mm / clear_gap_mm, 2));
      part(above, below, share * (seen_mm - (above - below)));
    }
  }

  // How much wider the mouth is in a frame than in the mixture of key shapes: these weights leave that out, since none
  // is negative.
  double missing_width_mm(const Landmarks& frame, const Weights& weights) const {
    if (!corners_ || !frame.points[corners_->first_mark].valid || !frame.points[corners_->second_mark].valid) return 0;
    double wider_px = width_px(frame) - width_px(neutral_);
    for (std::size_t k = 0; k < weights.values.size(); ++k)
      wider_px -=
          static_cast<double>(weights.values[k]) * (width_px(key_shapes_.shapes[k].landmarks) - width_px(neutral_));
    return mm_per_px_ * wider_px;
  }
  void widen(double by_mm, std::vector<VertexTarget>& targets) const {
    for (std::size_t i = 0; i < across_.size(); ++i) targets[i].x_mm += across_[i] * by_mm;
  }

 private:
  struct Pair {
    std::size_t first, second;            // places, which are the first targets
    std::size_t first_mark, second_mark;  // landmarks
  };
  static double gap_px(const Landmarks& landmarks, const Pair& pair) {
    return landmarks.points[pair.second_mark].y_px - landmarks.points[pair.first_mark].y_px;
  }
  double width_px(const Landmarks& landmarks) const {
    return landmarks.points[corners_->second_mark].x_px - landmarks.points[corners_->first_mark].x_px;
  }
  const KeyShapes& key_shapes_;
  const Landmarks& neutral_;
  double mm_per_px_ = 0;
  std::vector<Pair> pairs_;      // upper lip, lower lip
  std::optional<Pair> corners_;  // right, left
  std::vector<double> across_;   // of every place: -0.5 at the right corner, 0.5 at the left one; 0 beside the mouth
};

// Moves targets at rest to where the weights blend their vertices, in front. Each mesh is asked for once: it may have
// to be read from a disk.
void blend(const Rig& rig, const engine::Seq<Mesh>& key_meshes, const Weights& weights, const SeenMouth* mouth,
           std::vector<VertexTarget>& targets) {
  for (std::size_t k = 0; k < weights.values.size(); ++k) {
    if (weights.values[k] == 0) continue;
    const auto key = key_meshes.at(k);
    check(key->points_mm.size() == rig.neutral.points_mm.size(), "key mesh ", key_meshes.id(k), " has ",
          key->points_mm.size(), " vertices, expected ", rig.neutral.points_mm.size());
    Offsets offsets = offsets_of(rig, *key, targets);
    if (mouth != nullptr) mouth->apply(k, offsets);
    const auto weight = static_cast<double>(weights.values[k]);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      targets[i].x_mm += weight * offsets[i][0];
      targets[i].y_mm += weight * offsets[i][1];
    }
  }
}

}  // namespace

VertexTargets transfer_landmarks(const Rig& rig, const engine::Seq<Mesh>& key_meshes, const KeyShapes& key_shapes,
                                 const Weights& weights, const double* contact, const Landmarks* neutral,
                                 const Landmarks* frame) {
  check(!key_shapes.shapes.empty(), "there are no key shapes");
  check(!contact || (*contact >= 0 && *contact <= 1), "contact is ", contact ? *contact : 0, ", expected 0 to 1");
  VertexTargets targets;
  if (weights.values.empty()) return targets;
  check(weights.values.size() == key_meshes.size(), "there are ", weights.values.size(), " weights, expected ",
        key_meshes.size(), ", one per key mesh");
  const std::size_t vertices = rig.neutral.points_mm.size();
  const std::vector<LandmarkVertex> places = landmark_vertices(rig, key_shapes.shapes[0].landmarks);
  for (const LandmarkVertex& place : places) {
    check(place.vertex < vertices, "a landmark is vertex ", place.vertex, ", expected one below ", vertices);
    targets.targets.push_back(at_rest(rig, place.vertex));
  }
  const bool meets = contact && *contact > 0;
  const auto target_of = [&](std::uint32_t vertex) {
    check(vertex < vertices, "an inner lip is vertex ", vertex, ", expected one below ", vertices);
    const auto same = [&](const VertexTarget& target) { return target.vertex == vertex; };
    const auto at = std::find_if(targets.targets.begin(), targets.targets.end(), same);
    if (at != targets.targets.end()) return static_cast<std::size_t>(at - targets.targets.begin());
    targets.targets.push_back(at_rest(rig, vertex));
    return targets.targets.size() - 1;
  };
  std::vector<std::pair<std::size_t, std::size_t>> lips;
  for (const LipPair& pair : rig.inner_lips) {
    if (!meets) break;
    const std::size_t upper = target_of(pair.upper), lower = target_of(pair.lower);
    lips.emplace_back(upper, lower);
  }
  std::optional<SeenMouth> mouth;
  if (neutral != nullptr) {
    const std::size_t expected = key_shapes.shapes[0].landmarks.points.size();
    check(neutral->points.size() == expected, "neutral has ", neutral->points.size(), " landmarks, expected ", expected,
          " as the key shapes");
    check(frame == nullptr || frame->points.size() == expected, "frame has ", frame ? frame->points.size() : 0,
          " landmarks, expected ", expected, " as the key shapes");
    mouth.emplace(rig, key_shapes, places, *neutral);
  }
  blend(rig, key_meshes, weights, mouth ? &*mouth : nullptr, targets.targets);
  if (mouth && frame != nullptr) mouth->widen(mouth->missing_width_mm(*frame, weights), targets.targets);
  for (const auto& [upper, lower] : lips) {
    VertexTarget &above = targets.targets[upper], &below = targets.targets[lower];
    const auto gap_at_rest =
        static_cast<double>(rig.neutral.points_mm[above.vertex][1] - rig.neutral.points_mm[below.vertex][1]);
    const double open_mm = above.y_mm - below.y_mm - gap_at_rest;
    part(above.y_mm, below.y_mm, -*contact * open_mm);
  }
  return targets;
}

}  // namespace face::meshik
