// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/lip_colours.h"

#include <vector>

#include "nodes/base/check_image.h"
#include "nodes/track/face_contrast.h"
#include "nodes/track/light_change.h"
#include "nodes/track/lip_line.h"

namespace face::track {

LipColoursResult lip_colours(const Image& picture, const Landmarks& landmarks, const Matrix* light) {
  check_image(picture, "the image");
  Image room;
  const Image& image = in_start_light(picture, light ? light_of(*light) : LightChange{}, room);
  const MouthWidth width = mouth_width(landmarks);
  std::vector<LipLine> lines;
  for (int line = 1; line <= lip_lines; ++line) lines.push_back(lip_line(landmarks, line + 1));
  const FaceColours colours = colours_about(image, lines, width);
  LipColoursResult result;
  result.colours = {static_cast<std::size_t>(lip_lines * lip_line_samples), 3, {}};
  for (const LipLine& line : lines)
    for (const LipColour& colour : colours_along(colours, line, width))
      result.colours.values.insert(result.colours.values.end(), colour.begin(), colour.end());
  const LipColour contrast = face_contrast(image, landmarks);
  result.contrast = {1, 3, {contrast.begin(), contrast.end()}};
  return result;
}

}  // namespace face::track
