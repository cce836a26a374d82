// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/head_mask.h"

#include <string>

#include "nodes/base/check.h"
#include "nodes/mmm/check_picture.h"
#include "nodes/mmm/face_boxes.h"

namespace face::mmm {
namespace {

FaceBox from_shares(const std::vector<double>& shares, const std::string& name, const Image& frame) {
  check(shares.size() == 4, name, " has ", shares.size(), " numbers, expected 4: left, top, right, bottom");
  check(shares[0] < shares[2] && shares[1] < shares[3], name, " is from ", shares[0], ", ", shares[1], " to ",
        shares[2], ", ", shares[3], ", expected left < right and top < bottom");
  return {shares[0] * frame.width, shares[1] * frame.height, shares[2] * frame.width, shares[3] * frame.height};
}

}  // namespace

Image head_mask(const Image& frame, const Landmarks* landmarks, const HeadMaskOptions& options) {
  check_picture(frame, "frame");
  FaceBoxes boxes;
  boxes.head = from_shares(options.head, "head", frame);
  boxes.eyes = from_shares(options.eyes, "eyes", frame);
  boxes.mouth = from_shares(options.mouth, "mouth", frame);
  if (landmarks) boxes = find_face_boxes(*landmarks, frame.width, frame.height);
  const auto& [left, top, right, bottom] = boxes.head;
  Image mask{frame.width, frame.height, 1, {}};
  const double cx = (left + right) / 2, cy = (top + bottom) / 2;
  const double rx = (right - left) / 2, ry = (bottom - top) / 2;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const double dx = (x - cx) / rx, dy = (y - cy) / ry;
      const bool on = dx * dx + dy * dy <= 1 && !boxes.eyes.holds(x, y) && !boxes.mouth.holds(x, y);
      mask.pixels.push_back(on ? 255 : 0);
    }
  return mask;
}

}  // namespace face::mmm
