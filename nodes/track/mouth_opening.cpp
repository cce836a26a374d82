// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/mouth_opening.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check_image.h"
#include "nodes/base/find_landmark.h"
#include "nodes/track/light_change.h"
#include "nodes/track/lip_line.h"

namespace face::track {
namespace {

constexpr double lip_from = 0.08, lip_to = 0.22;            // of the line, from each end: surely lip
constexpr double edge = 0.12;                               // of the line, at each end: what blurs into the skin
constexpr std::array<double, 3> deviation{0.1, 0.3, 0.15};  // red and blue to green (logarithms), share of brightness

// Mean over the samples whose place is from `from` to `to`.
LipColour mean_colour(const std::vector<LipColour>& colours, double from, double to) {
  LipColour mean{};
  double count = 0;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double v = (static_cast<double>(i) + 0.5) / lip_line_samples;
    if (v < from || v > to) continue;
    for (std::size_t c = 0; c < 3; ++c) mean[c] += colours[i][c];
    ++count;
  }
  for (double& value : mean) value /= count;
  return mean;
}

// What a mouth's height is held against. Not its width, where the eyes are seen: lips that meet in a pout are as thick
// as others, on a narrower mouth.
double usual_width_px(const Landmarks& landmarks, const MouthWidth& width) {
  constexpr double mouth_of_eyes = 1.5;  // widths of the mouth in distances of the inner corners of the eyes
  const Landmark *right = find_landmark(landmarks, "eye_inner_r"), *left = find_landmark(landmarks, "eye_inner_l");
  if (!right || !left || !right->valid || !left->valid) return width.length_px();
  return mouth_of_eyes * distance_px(*right, *left);
}

}  // namespace

double mouth_opening(const Image& picture, const Landmarks& landmarks, const Matrix* light) {
  check_image(picture, "the image");
  Image room;
  const Image& image = in_start_light(picture, light ? light_of(*light) : LightChange{}, room);
  const MouthWidth width = mouth_width(landmarks);
  const LipLine line = lip_line(landmarks, 3);
  const LipLine corners = {find_landmark(landmarks, "lip_0"), find_landmark(landmarks, "lip_6")};
  if (!line.upper->valid || !line.lower->valid || !corners.upper->valid || !corners.lower->valid) return -1;
  std::vector<LipColour> colours = colours_along(colours_about(image, {line}, width), line, width);
  const LipColour above = mean_colour(colours, lip_from, lip_to),
                  below = mean_colour(colours, 1 - lip_to, 1 - lip_from);
  const double lips_luma = std::max(0.02, (above[2] + below[2]) / 2);
  double sum = 0;
  for (int i = 0; i < lip_line_samples; ++i) {
    const double v = (i + 0.5) / lip_line_samples;
    if (v < edge || v > 1 - edge) continue;
    const double middle = (lip_from + lip_to) / 2, share = std::clamp((v - middle) / (1 - 2 * middle), 0.0, 1.0);
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double lips = above[c] + share * (below[c] - above[c]);
      const double unlike = (colours[static_cast<std::size_t>(i)][c] - lips) / (c == 2 ? lips_luma : 1);
      square += std::pow(unlike / deviation[c], 2);
    }
    sum += std::sqrt(square) / lip_line_samples;
  }
  const double height_px = std::hypot(line.lower->x_px - line.upper->x_px, line.lower->y_px - line.upper->y_px);
  return sum * height_px / std::max(1.0, usual_width_px(landmarks, width));
}

}  // namespace face::track
