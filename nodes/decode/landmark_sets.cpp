// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/landmark_sets.h"

#include <array>
#include <string>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/base/clip_points.h"

namespace face::decode {
namespace {

// The vertices of MediaPipe's canonical face model that are Multi-PIE's points 0 to 67.
constexpr std::array<std::size_t, 68> media_pipe_vertices = {
    127, 234, 93,  58,  172, 136, 150, 149, 152, 378, 379, 365, 397, 288, 323, 454, 356,  // outline, from his right
    70,  63,  105, 66,  107, 336, 296, 334, 293, 300,                                     // brows
    168, 197, 5,   4,   98,  97,  2,   326, 327,                                          // nose
    33,  160, 158, 133, 153, 144, 362, 385, 387, 263, 373, 380,                           // eyes
    61,  40,  37,  0,   267, 270, 291, 321, 314, 17,  84,  91,                            // lips, outside
    78,  82,  13,  312, 308, 317, 14,  87};                                               // lips, inside

}  // namespace

Landmarks multi_pie_of_media_pipe(const Landmarks& mesh) {
  check(mesh.points.size() >= 468, "MediaPipe's face mesh has ", mesh.points.size(), " points, expected 468 or 478");
  Landmarks result;
  for (std::size_t i = 0; i < media_pipe_vertices.size(); ++i) {
    result.points.push_back(mesh.points[media_pipe_vertices[i]]);
    result.points.back().name = std::to_string(i);
  }
  return with_two_digits(std::move(result));
}

Landmarks with_two_digits(Landmarks points) {
  for (Landmark& point : points.points)
    if (point.name.size() == 1 && point.name[0] >= '0' && point.name[0] <= '9') point.name.insert(0, 1, '0');
  return points;
}

Landmarks clip_points_of_multi_pie(const Landmarks& points) {
  check(points.points.size() == 68, "there are ", points.points.size(), " points, expected Multi-PIE's 68");
  Landmarks result;
  for (const auto& [name, number] : clip_points) {
    result.points.push_back(points.points[number]);
    result.points.back().name = name;
  }
  return result;
}

}  // namespace face::decode
