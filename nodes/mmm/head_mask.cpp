// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/head_mask.h"

#include <algorithm>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/mmm/check_picture.h"

namespace face::mmm {
namespace {

struct Box {
  double left, top, right, bottom;
  bool holds(double x, double y) const { return x >= left && x <= right && y >= top && y <= bottom; }
};

Box from_shares(const std::vector<double>& shares, const std::string& name, const Image& frame) {
  check(shares.size() == 4, name, " has ", shares.size(), " numbers, expected 4: left, top, right, bottom");
  check(shares[0] < shares[2] && shares[1] < shares[3], name, " is from ", shares[0], ", ", shares[1], " to ",
        shares[2], ", ", shares[3], ", expected left < right and top < bottom");
  return {shares[0] * frame.width, shares[1] * frame.height, shares[2] * frame.width, shares[3] * frame.height};
}

const Landmark& find(const Landmarks& landmarks, int number) {
  const std::string name = (number < 10 ? "0" : "") + std::to_string(number);
  if (const Landmark* point = find_landmark(landmarks, name)) return *point;
  fail("landmark ", name, " is missing, expected the 68 of Multi-PIE");
}

Box around(const Landmarks& landmarks, const std::vector<std::pair<int, int>>& runs) {
  Box box{1e9, 1e9, -1e9, -1e9};
  for (const auto& [first, last] : runs)
    for (int i = first; i <= last; ++i) {
      const Landmark& p = find(landmarks, i);
      box = {std::min(box.left, p.x_px), std::min(box.top, p.y_px), std::max(box.right, p.x_px),
             std::max(box.bottom, p.y_px)};
    }
  return box;
}

}  // namespace

Image head_mask(const Image& frame, const Landmarks* landmarks, const HeadMaskOptions& options) {
  check_picture(frame, "frame");
  Box head = from_shares(options.head, "head", frame);
  Box eyes = from_shares(options.eyes, "eyes", frame);
  Box mouth = from_shares(options.mouth, "mouth", frame);
  if (landmarks) {
    head = around(*landmarks, {{0, 26}});
    eyes = around(*landmarks, {{17, 26}, {36, 47}});
    const double tall = eyes.bottom - eyes.top;
    head.top -= tall;
    eyes = {eyes.left - 0.2 * tall, eyes.top - 0.2 * tall, eyes.right + 0.2 * tall, eyes.bottom + 0.2 * tall};
    const Box nose = around(*landmarks, {{31, 35}});
    mouth = {head.left, nose.bottom, head.right, frame.height * 1.0};
  }
  Image mask{frame.width, frame.height, 1, {}};
  const double cx = (head.left + head.right) / 2, cy = (head.top + head.bottom) / 2;
  const double rx = (head.right - head.left) / 2, ry = (head.bottom - head.top) / 2;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const double dx = (x - cx) / rx, dy = (y - cy) / ry;
      const bool on = dx * dx + dy * dy <= 1 && !eyes.holds(x, y) && !mouth.holds(x, y);
      mask.pixels.push_back(on ? 255 : 0);
    }
  return mask;
}

}  // namespace face::mmm
