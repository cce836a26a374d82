// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "nodes/types/landmarks.h"

namespace face {

// Index of the point of this name; the number of points where there is none.
inline std::size_t landmark_index(const Landmarks& landmarks, std::string_view name) {
  const auto point =
      std::find_if(landmarks.points.begin(), landmarks.points.end(), [&](const Landmark& p) { return p.name == name; });
  return static_cast<std::size_t>(point - landmarks.points.begin());
}

// The point of this name; null where there is none.
inline const Landmark* find_landmark(const Landmarks& landmarks, std::string_view name) {
  const std::size_t index = landmark_index(landmarks, name);
  return index < landmarks.points.size() ? &landmarks.points[index] : nullptr;
}

inline double distance_px(const Landmark& a, const Landmark& b) { return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px); }

// A coordinate in the same picture at another size. Pixel 0 is the first one's centre in both.
inline double scaled_px(double at_px, int from_size_px, int to_size_px) {
  return (at_px + 0.5) * to_size_px / from_size_px - 0.5;
}

// "lip_0, lip_6": for errors.
inline std::string landmark_names(const Landmarks& landmarks) {
  std::string names;
  for (const Landmark& point : landmarks.points) names += (names.empty() ? "" : ", ") + point.name;
  return names;
}

}  // namespace face
