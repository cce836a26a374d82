// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/raise_jaw.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/meshik/mouth_fit.h"
#include "nodes/types/arkit.h"

namespace face::meshik {
namespace {

constexpr std::size_t jaw_open = arkit_index("jawOpen"), mouth_close = arkit_index("mouthClose");
constexpr std::size_t upper_lip = 62, lower_lip = 66;  // where a rig names no pairs: the middle of the inner edges
constexpr std::size_t enough_frames = 2000;            // evenly spread; the jaw's highest places show in fewer
constexpr double resting_share = 0.025;  // of the frames; closures in a row are up to 0.011 (18,000 frames)

double offset_y_mm(const Shape& shape, std::uint32_t vertex) {
  const auto at = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), vertex);
  if (at == shape.vertices.end() || *at != vertex) return 0;
  return static_cast<double>(shape.offsets_mm[static_cast<std::size_t>(at - shape.vertices.begin())][1]);
}

// How far the shape takes the lips apart.
double parts_lips_mm(const Rig& rig, std::size_t shape) {
  std::vector<LipPair> pairs = rig.inner_lips;
  if (pairs.empty()) pairs.push_back({rig.landmarks68[upper_lip], rig.landmarks68[lower_lip]});
  double sum = 0;
  for (const LipPair& pair : pairs)
    sum += offset_y_mm(rig.shapes[shape], pair.upper) - offset_y_mm(rig.shapes[shape], pair.lower);
  return sum / static_cast<double>(pairs.size());
}

// jawOpen of one frame, counted from rest.
double jaw_of(const MouthFit& fit, const std::vector<LandmarkVertex>& places, const Landmarks& here,
              const Landmarks& rest, double mm_per_px, const std::vector<double>& least) {
  std::vector<double> wanted;
  std::vector<bool> seen;
  for (const LandmarkVertex& place : places) {
    const Landmark &point = here.points[place.landmark], &at_rest = rest.points[place.landmark];
    seen.push_back(point.valid);
    wanted.push_back(mm_per_px * (point.x_px - at_rest.x_px));
    wanted.push_back(-mm_per_px * (point.y_px - at_rest.y_px));
  }
  return fit.weights(wanted, least, seen)[jaw_open];
}

// The outer lips' points, 2 numbers each, about their mean; empty where one is lost.
std::vector<double> lip_shape(const Landmarks& here, const std::vector<LandmarkVertex>& places, const Rig& rig) {
  std::vector<double> shape;
  double mean_x = 0, mean_y = 0;
  for (const LandmarkVertex& place : places) {
    const auto first = rig.landmarks68.begin() + 48, last = first + 12;
    if (std::find(first, last, place.vertex) == last) continue;
    const Landmark& point = here.points[place.landmark];
    if (!point.valid) return {};
    shape.push_back(point.x_px);
    shape.push_back(point.y_px);
    mean_x += point.x_px;
    mean_y += point.y_px;
  }
  for (std::size_t i = 0; i < shape.size(); ++i)
    shape[i] -= (i % 2 == 0 ? mean_x : mean_y) * 2 / static_cast<double>(shape.size());
  return shape;
}

// How many frames are part of at least `in_a_row` whose lips have the shape of rest's.
int count_resting(const Rig& rig, const engine::Seq<Landmarks>& landmarks, const Landmarks& rest,
                  const std::vector<LandmarkVertex>& places, int in_a_row) {
  constexpr double alike = 0.025;  // of the mouth's width
  Landmarks all = rest;
  for (Landmark& point : all.points) point.valid = true;
  const std::vector<double> wanted = lip_shape(all, places, rig);
  double low = 0, high = 0;
  for (std::size_t i = 0; i < wanted.size(); i += 2) low = std::min(low, wanted[i]), high = std::max(high, wanted[i]);
  int resting = 0, run = 0;
  for (std::size_t t = 0; t < landmarks.size(); ++t) {
    const std::vector<double> shape = lip_shape(*landmarks.at(t), places, rig);
    double sum = 0;
    for (std::size_t i = 0; i < shape.size(); ++i)
      sum += 2 * std::pow(shape[i] - wanted[i], 2) / static_cast<double>(shape.size());
    run = !shape.empty() && std::sqrt(sum) <= alike * (high - low) ? run + 1 : 0;
    if (run >= in_a_row) resting += run == in_a_row ? run : 1;
  }
  return resting;
}

std::vector<double> median_of_three(const std::vector<double>& values) {
  std::vector<double> out = values;
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    out[i] = std::max(std::min(values[i - 1], values[i]), std::min(std::max(values[i - 1], values[i]), values[i + 1]));
  return out;
}

}  // namespace

Landmarks raise_jaw(const Rig& rig, const engine::Seq<Landmarks>& landmarks, const Landmarks& rest,
                    const Visemes* visemes, const RaiseJawOptions& options) {
  const std::vector<LandmarkVertex> places = landmark_vertices(rig, rest);
  const MouthFit fit(rig, places, visemes, {});
  if (rig.shapes.size() <= std::max(jaw_open, mouth_close) || fit.row(jaw_open).empty() || fit.row(mouth_close).empty())
    return rest;
  const double per_jaw = parts_lips_mm(rig, jaw_open), per_close = parts_lips_mm(rig, mouth_close);
  if (per_jaw <= 0 || per_close >= 0) return rest;
  const double mm_per_px = landmark_scale_mm(rig, rest, places);
  std::vector<double> least(rig.shapes.size(), 0.0), jaws;
  least[jaw_open] = least[mouth_close] = -1;
  const std::size_t every = std::max<std::size_t>(1, landmarks.size() / enough_frames);
  for (std::size_t t = 0; t < landmarks.size(); t += every) {
    const auto here = landmarks.at(t);
    check(here->points.size() == rest.points.size(), "frame ", landmarks.id(t), " has ", here->points.size(),
          " landmarks, expected ", rest.points.size(), " as rest");
    const auto lost =
        std::count_if(here->points.begin(), here->points.end(), [](const Landmark& p) { return !p.valid; });
    if (lost <= options.max_lost) jaws.push_back(jaw_of(fit, places, *here, rest, mm_per_px, least));
  }
  const int resting = count_resting(rig, landmarks, rest, places, options.rest_frames);
  if (jaws.empty() || resting >= resting_share * static_cast<double>(landmarks.size())) return rest;
  jaws = median_of_three(jaws);
  std::sort(jaws.begin(), jaws.end());
  const auto above =
      std::max<std::size_t>(2, static_cast<std::size_t>(options.highest_share * static_cast<double>(jaws.size())));
  const double raise = std::clamp(-jaws[std::min(above, jaws.size() - 1)], 0.0, options.most);
  const double close = -raise * per_jaw / per_close;
  Landmarks raised = rest;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto moved_mm = [&](std::size_t d) {
      return raise * fit.row(jaw_open)[2 * i + d] + close * fit.row(mouth_close)[2 * i + d];
    };
    raised.points[places[i].landmark].x_px -= moved_mm(0) / mm_per_px;
    raised.points[places[i].landmark].y_px += moved_mm(1) / mm_per_px;
  }
  return raised;
}

}  // namespace face::meshik
