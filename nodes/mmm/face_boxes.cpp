// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/face_boxes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"

namespace face::mmm {
namespace {

// Of the distance of the inner corners of the eyes.
constexpr double half_face = 2.2, hair_line = 2.4, half_eyes = 1.75, above_eyes = 1.2, below_eyes = 0.5;
constexpr double half_lower_face = 2.35, above_nose_tip = 0.35, below_chin = 1.0;

const Landmark* numbered(const Landmarks& landmarks, int number) {
  const std::string name = std::to_string(number);
  const Landmark* const point = find_landmark(landmarks, name);
  return point || number > 9 ? point : find_landmark(landmarks, "0" + name);
}

const Landmark& of_68(const Landmarks& landmarks, int number) {
  const Landmark* const point = numbered(landmarks, number);
  check(point != nullptr, "landmark ", number, " is missing, expected the 68 of Multi-PIE");
  return *point;
}

const Landmark& of_clip(const Landmarks& landmarks, const char* name) {
  const Landmark* const point = find_landmark(landmarks, name);
  check(point != nullptr, "landmark ", name, " is missing: found ", landmark_names(landmarks),
        ", expected eye_inner_r, eye_inner_l, nose_tip, lip_0, lip_6 and chin, or the 68 of Multi-PIE");
  return *point;
}

FaceBox around(const Landmarks& landmarks, const std::vector<std::pair<int, int>>& runs) {
  FaceBox box{1e9, 1e9, -1e9, -1e9};
  for (const auto& [first, last] : runs)
    for (int i = first; i <= last; ++i) {
      const Landmark& p = of_68(landmarks, i);
      box = {std::min(box.left, p.x_px), std::min(box.top, p.y_px), std::max(box.right, p.x_px),
             std::max(box.bottom, p.y_px)};
    }
  return box;
}

}  // namespace

FaceBoxes find_face_boxes(const Landmarks& landmarks, int width_px, int height_px) {
  const bool whole = numbered(landmarks, 0) != nullptr;
  const auto point = [&](int number, const char* name) -> const Landmark& {
    return whole ? of_68(landmarks, number) : of_clip(landmarks, name);
  };
  const Landmark &right_eye = point(39, "eye_inner_r"), &left_eye = point(42, "eye_inner_l"),
                 &nose = point(30, "nose_tip"), &right_corner = point(48, "lip_0"), &left_corner = point(54, "lip_6"),
                 &chin = point(8, "chin");
  const double unit = std::hypot(left_eye.x_px - right_eye.x_px, left_eye.y_px - right_eye.y_px);
  check(unit > 0, "the inner corners of the eyes lie on one another at ", left_eye.x_px, ", ", left_eye.y_px);
  const double x = (right_eye.x_px + left_eye.x_px) / 2, y = (right_eye.y_px + left_eye.y_px) / 2;
  FaceBoxes boxes;
  if (whole) {
    boxes.head = around(landmarks, {{0, 26}});
    FaceBox& eyes = boxes.eyes = around(landmarks, {{17, 26}, {36, 47}});
    const double tall = eyes.bottom - eyes.top;
    boxes.head.top -= tall;
    eyes = {eyes.left - 0.2 * tall, eyes.top - 0.2 * tall, eyes.right + 0.2 * tall, eyes.bottom + 0.2 * tall};
    boxes.mouth = {boxes.head.left, around(landmarks, {{31, 35}}).bottom, boxes.head.right, height_px * 1.0};
  } else {
    boxes.head = {x - half_face * unit, y - hair_line * unit, x + half_face * unit, chin.y_px};
    boxes.eyes = {x - half_eyes * unit, y - above_eyes * unit, x + half_eyes * unit, y + below_eyes * unit};
    boxes.mouth = {boxes.head.left, nose.y_px, boxes.head.right, height_px * 1.0};
  }
  const double middle = (right_corner.x_px + left_corner.x_px) / 2;
  boxes.lower_face = {std::max(0.0, std::round(middle - half_lower_face * unit)),
                      std::max(0.0, std::round(nose.y_px - above_nose_tip * unit)),
                      std::min<double>(width_px, std::round(middle + half_lower_face * unit)),
                      std::min<double>(height_px, std::round(chin.y_px + below_chin * unit))};
  check(boxes.lower_face.left < boxes.lower_face.right && boxes.lower_face.top < boxes.lower_face.bottom,
        "the lower face lies outside the picture of ", width_px, " x ", height_px, " pixels: the chin is at ",
        chin.x_px, ", ", chin.y_px);
  return boxes;
}

}  // namespace face::mmm
