// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/lip_line.h"

#include <cmath>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"

namespace face::track {
namespace {

constexpr double strip = 0.05;  // half width of what is averaged, of the mouth's

const Landmark& point_of(const Landmarks& landmarks, int lip) {
  const std::string name = "lip_" + std::to_string(lip);
  const Landmark* point = find_landmark(landmarks, name);
  check(point != nullptr, "there is no landmark ", name, ": the lips' points are lip_0 to lip_11");
  return *point;
}

}  // namespace

double MouthWidth::length_px() const { return std::hypot(x_px, y_px); }

MouthWidth mouth_width(const Landmarks& landmarks) {
  const Landmark &right = point_of(landmarks, 0), &left = point_of(landmarks, 6);
  return {left.x_px - right.x_px, left.y_px - right.y_px};
}

LipLine lip_line(const Landmarks& landmarks, int upper) {
  return {&point_of(landmarks, upper), &point_of(landmarks, 12 - upper)};
}

FaceColours colours_about(const Image& image, const std::vector<LipLine>& lines, const MouthWidth& width) {
  Box box;
  for (const LipLine& line : lines)
    for (const Landmark* end : {line.upper, line.lower}) box.include(end->x_px, end->y_px);
  return {image, box, width.length_px() * strip + 2};
}

std::vector<LipColour> colours_along(const FaceColours& colours, const LipLine& line, const MouthWidth& width) {
  std::vector<LipColour> out;
  for (int i = 0; i < lip_line_samples; ++i) {
    const double v = (i + 0.5) / lip_line_samples;
    const double x = (1 - v) * line.upper->x_px + v * line.lower->x_px;
    const double y = (1 - v) * line.upper->y_px + v * line.lower->y_px;
    LipColour mean{};
    for (const double t : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      const LipColour one = colours.at(x + t * strip * width.x_px, y + t * strip * width.y_px);
      for (std::size_t c = 0; c < 3; ++c) mean[c] += one[c] / 5;
    }
    out.push_back(mean);
  }
  return out;
}

std::vector<LipColour> colours_of_line(const Matrix& colours, int line) {
  constexpr std::size_t samples = lip_line_samples, rows = lip_lines * samples;
  check(colours.rows == rows && colours.columns == 3 && colours.values.size() == 3 * rows, "colours is ", colours.rows,
        " x ", colours.columns, ", expected ", rows, " x 3 as lip_colours gives it");
  std::vector<LipColour> out;
  for (std::size_t row = static_cast<std::size_t>(line - 1) * samples; out.size() < samples; ++row) {
    for (std::size_t c = 0; c < 3; ++c)
      check(std::isfinite(colours.at(row, c)), "colours has ", colours.at(row, c), ", expected finite numbers");
    out.push_back({colours.at(row, 0), colours.at(row, 1), colours.at(row, 2)});
  }
  return out;
}

double place_on_line(std::size_t sample) { return (static_cast<double>(sample) + 0.5) / lip_line_samples; }

double mean_between(const std::vector<double>& samples, double from, double to) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (place_on_line(i) >= from && place_on_line(i) <= to) sum += samples[i], ++count;
  return sum / count;
}

}  // namespace face::track
