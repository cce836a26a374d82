// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/landmark_vertices.h"

#include "nodes/base/check.h"
#include "nodes/base/clip_points.h"

namespace face::meshik {

std::vector<LandmarkVertex> landmark_vertices(const Rig& rig, const Landmarks& landmarks) {
  check(rig.landmarks68.size() == 68, "the rig has ", rig.landmarks68.size(),
        " landmarks, expected 68, as the embedded head, ICT-FaceKit folders and GLB files that were made of these "
        "have; transfer.mark_landmarks finds those of another head");
  const auto place = [](const std::string& name) -> int {
    for (const auto& [known, number] : clip_points)
      if (name == known) return static_cast<int>(number);
    for (int i = 0; i < 8; ++i)
      if (name == "inner_lip_" + std::to_string(i)) return 60 + i;
    if (name.size() == 2 && name[0] >= '0' && name[0] <= '6' && name[1] >= '0' && name[1] <= '9') {
      const int number = 10 * (name[0] - '0') + name[1] - '0';
      return number < 68 ? number : -1;
    }
    return -1;
  };
  std::vector<LandmarkVertex> found;
  for (std::size_t i = 0; i < landmarks.points.size(); ++i) {
    const int at = place(landmarks.points[i].name);
    if (at >= 0)
      found.push_back({i, rig.landmarks68[static_cast<std::size_t>(at)], at, at == 30 || at == 39 || at == 42});
  }
  check(!found.empty(),
        "no landmark is called lip_0 to lip_11, jaw_r, chin, jaw_l, eye_inner_r, eye_inner_l or nose_tip");
  return found;
}

double landmark_scale_mm(const Rig& rig, const Landmarks& neutral, const std::vector<LandmarkVertex>& places) {
  double mean[4] = {}, along = 0, size = 0;
  const auto values = [&](const LandmarkVertex& place, double(&v)[4]) {
    v[0] = neutral.points[place.landmark].x_px;
    v[1] = -neutral.points[place.landmark].y_px;
    v[2] = static_cast<double>(rig.neutral.points_mm[place.vertex][0]);
    v[3] = static_cast<double>(rig.neutral.points_mm[place.vertex][1]);
  };
  double v[4];
  for (const LandmarkVertex& place : places) {
    values(place, v);
    for (std::size_t i = 0; i < 4; ++i) mean[i] += v[i] / static_cast<double>(places.size());
  }
  for (const LandmarkVertex& place : places) {
    values(place, v);
    for (std::size_t d = 0; d < 2; ++d) {
      along += (v[d] - mean[d]) * (v[2 + d] - mean[2 + d]);
      size += (v[d] - mean[d]) * (v[d] - mean[d]);
    }
  }
  check(size > 0 && along > 0, "the neutral landmarks do not lie as those of an upright face do");
  return along / size;
}

}  // namespace face::meshik
