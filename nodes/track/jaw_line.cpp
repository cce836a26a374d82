// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/jaw_line.h"
#include "nodes/base/find_landmark.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace face::track {
namespace {

using Vector2 = Eigen::Vector2d;

// Of a profile, in steps of a thirtieth of the mouth's width: samples across the line, and columns along it that each
// is the mean of.
constexpr int half_samples = 6, half_columns = 2;
constexpr int samples = 2 * half_samples + 1;
constexpr int parts = 4;  // of a step, in which the line is looked for
constexpr int reach = 4;  // steps

struct Frame {
  Vector2 normal, along;
  double step_px;
};

Vector2 place_of(const Landmarks& points, std::size_t i) { return {points.points[i].x_px, points.points[i].y_px}; }

Frame frame_of(const Landmarks& points, const std::vector<std::size_t>& line, const std::vector<std::size_t>& outline,
               double mouth_px) {
  Vector2 mouth = Vector2::Zero();
  for (const std::size_t i : outline) mouth += place_of(points, i) / static_cast<double>(outline.size());
  Vector2 along = place_of(points, line.back()) - place_of(points, line.front());
  along /= std::max(along.norm(), 1e-9);
  Vector2 normal(-along.y(), along.x());
  if (normal.dot(place_of(points, line[line.size() / 2]) - mouth) < 0) normal = -normal;
  return {normal, along, mouth_px / 30};
}

// Grey values across the line at every part of a step within `steps` of a place.
std::vector<double> profile(const Grey& grey, const Vector2& place, const Frame& frame, int steps) {
  std::vector<double> values;
  for (int k = -steps * parts; k <= steps * parts; ++k) {
    double sum = 0;
    for (int t = -half_columns; t <= half_columns; ++t) {
      const Vector2 p = place + frame.step_px * (static_cast<double>(k) / parts * frame.normal + t * frame.along);
      sum += static_cast<double>(grey.at(p.x(), p.y()));
    }
    values.push_back(sum / (2 * half_columns + 1));
  }
  return values;
}

struct Difference {
  double unlike = 1;    // 0 = equal but for light, 1 = nothing in common
  double contrast = 0;  // deviation of the wanted grey values
};

// The root of the part of two profiles that no offset and no gain that light can have explains.
Difference difference(const Matrix& look, std::size_t row, const double* seen) {
  constexpr double least_gain = 0.6, most_gain = 1.7;
  double weights = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int s = 0; s < samples; ++s) {
    const double weight = std::exp(-0.5 * std::pow((s - half_samples) / 3.0, 2));
    const double x = look.at(row, static_cast<std::size_t>(s)), y = seen[s * parts];
    weights += weight, a += weight * x, b += weight * y;
    aa += weight * x * x, bb += weight * y * y, ab += weight * x * y;
  }
  a /= weights, b /= weights;
  aa = aa / weights - a * a;
  bb = bb / weights - b * b;
  ab = ab / weights - a * b;
  if (aa < 1e-6) return {};
  const double gain = std::clamp(ab / aa, least_gain, most_gain);
  const double rest = bb - 2 * gain * ab + gain * gain * aa;
  return {std::sqrt(std::clamp(rest / std::max(bb, gain * gain * aa), 0.0, 1.0)), std::sqrt(aa)};
}

}  // namespace

std::vector<std::size_t> find_jaw_line(const Landmarks& start, const std::vector<std::string>& names) {
  std::vector<std::size_t> line;
  for (const std::string& name : names) {
    line.push_back(landmark_index(start, name));
    if (line.back() == start.points.size()) return {};
  }
  return line;
}

Matrix learn_jaw_line(const Grey& grey, const Landmarks& points, const std::vector<std::size_t>& line,
                      const std::vector<std::size_t>& outline, double mouth_px) {
  const Frame frame = frame_of(points, line, outline, mouth_px);
  Matrix look{line.size(), samples, {}};
  for (const std::size_t i : line) {
    const std::vector<double> values = profile(grey, place_of(points, i), frame, half_samples);
    for (std::size_t s = 0; s < samples; ++s) look.values.push_back(values[s * parts]);
  }
  return look;
}

EdgeSight see_jaw_line(const Grey& grey, const Landmarks& expected, const std::vector<std::size_t>& line,
                       const std::vector<std::size_t>& outline, double mouth_px, const Matrix& look) {
  constexpr double unlike = 0.25, stray_steps = 4;     // deviations: of what is right, of the shift from expected
  constexpr double survives = 0.5, error_steps = 0.4;  // of the unlikeness that a sighting survives; of its place
  constexpr double noise = 6;                          // grey values; contrast below it says little
  const Frame frame = frame_of(expected, line, outline, mouth_px);
  EdgeSight out;
  for (std::size_t row = 0; row < line.size(); ++row) {
    const Vector2 place = place_of(expected, line[row]);
    const std::vector<double> values = profile(grey, place, frame, half_samples + reach);
    std::vector<double> costs, errors;
    double contrast = 0;
    for (int k = 0; k <= 2 * reach * parts; ++k) {
      const Difference here = difference(look, row, &values[static_cast<std::size_t>(k)]);
      const double shift = static_cast<double>(k) / parts - reach;
      errors.push_back(here.unlike);
      costs.push_back(std::pow(here.unlike / unlike, 2) + std::pow(shift / stray_steps, 2));
      contrast = here.contrast;
    }
    const auto best = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    double shift = static_cast<double>(best) / parts - reach;
    if (best > 0 && best + 1 < costs.size()) {
      const double a = costs[best - 1], b = costs[best], c = costs[best + 1];
      if (a + c - 2 * b > 1e-12) shift += 0.5 / parts * (a - c) / (a + c - 2 * b);
    }
    const double likeness = std::exp(-0.5 * std::pow(errors[best] / survives, 2)) * contrast * contrast /
                            (contrast * contrast + noise * noise);
    const double sure = likeness / std::pow(error_steps * frame.step_px, 2);
    const Vector2 seen = place + shift * frame.step_px * frame.normal;
    out.likeness.push_back(likeness);
    out.sightings.push_back({seen.x(), seen.y(), sure * frame.normal.x() * frame.normal.x(),
                             sure * frame.normal.x() * frame.normal.y(), sure * frame.normal.y() * frame.normal.y()});
  }
  return out;
}

}  // namespace face::track
