// SPDX-License-Identifier: Apache-2.0
// Colours on a line across the mouth, from a point of the outer upper lip to the one below it. Internal to the area.
#pragma once
#include <array>
#include <vector>

#include "nodes/track/face_colours.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

constexpr int lip_line_samples = 64;
constexpr int lip_lines = 3;  // from lip_2, lip_3 and lip_4
// Shares of a line, from each end: surely lip; what blurs into the skin.
constexpr double lip_from = 0.08, lip_to = 0.22, lip_line_edge = 0.12;
using LipColour = std::array<double, 3>;  // as FaceColours::at

struct LipLine {
  const Landmark *upper, *lower;
};

// From the right to the left corner of the mouth.
struct MouthWidth {
  double x_px = 0, y_px = 0;
  double length_px() const;
};

MouthWidth mouth_width(const Landmarks& landmarks);
// upper: 1 to 5; lip_3 is opposite lip_9. The landmarks have to outlive the line. Throws where a point is missing.
LipLine lip_line(const Landmarks& landmarks, int upper);
FaceColours colours_about(const Image& image, const std::vector<LipLine>& lines, const MouthWidth& width);
// lip_line_samples of them, evenly from the upper to the lower end, each the mean over a short stretch along the mouth.
std::vector<LipColour> colours_along(const FaceColours& colours, const LipLine& line, const MouthWidth& width);
// Those of the line from lip_2, lip_3 or lip_4 (line: 1, 2, 3) of what lip_colours.h gives. Throws where it is
// something else.
std::vector<LipColour> colours_of_line(const Matrix& colours, int line);
// Where a sample lies on its line, 0 to 1.
double place_on_line(std::size_t sample);
// Mean over the samples whose place is from `from` to `to`.
double mean_between(const std::vector<double>& samples, double from, double to);

}  // namespace face::track
