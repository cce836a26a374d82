// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_landmarks.h"

#include <nlohmann/json.hpp>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/json_file.h"

namespace face::decode {

ReadLandmarksResult read_landmarks(const engine::File& file) {
  const std::string title = title_of(file);
  const nlohmann::ordered_json json = read_json(file);
  const auto& size = json_member(json, "image_size", title, "");
  if (!size.is_array() || size.size() != 2)
    fail(title, " at /image_size: found ", describe_json(size), ", expected [width, height] in pixels");
  ReadLandmarksResult result;
  result.image_width_px = json_index(size[0], title, "/image_size/0");
  result.image_height_px = json_index(size[1], title, "/image_size/1");
  const auto& points = json_member(json, "points", title, "");
  if (!points.is_object() || points.empty())
    fail(title, " at /points: found ", describe_json(points), ", expected an object of names with [x, y]");
  for (const auto& [name, xy] : points.items()) {
    Landmark point{name, 0, 0, true};
    json_xy(xy, title, "/points/" + name, point.x_px, point.y_px);
    const bool inside = point.x_px >= -0.5 && point.y_px >= -0.5 &&
                        point.x_px <= static_cast<double>(result.image_width_px) - 0.5 &&
                        point.y_px <= static_cast<double>(result.image_height_px) - 0.5;
    if (!inside)
      fail(title, " at /points/", name, ": found (", point.x_px, ", ", point.y_px,
           "), expected a point inside the image of ", result.image_width_px, " x ", result.image_height_px, " pixels");
    result.landmarks.points.push_back(point);
  }
  return result;
}

}  // namespace face::decode
