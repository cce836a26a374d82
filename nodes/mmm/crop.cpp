// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/crop.h"

#include <cstddef>

#include "nodes/base/check.h"
#include "nodes/base/image_part.h"
#include "nodes/mmm/face_boxes.h"

namespace face::mmm {

Image crop(const Image& image, const Landmarks* landmarks, const CropOptions& options) {
  check(image.width > 0 && image.height > 0 &&
            image.pixels.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                       static_cast<std::size_t>(image.channels),
        "image has ", image.pixels.size(), " values, expected ", image.width, " x ", image.height, " pixels of ",
        image.channels, " channels");
  CropOptions o = options;
  if (landmarks) {
    const FaceBox box = find_face_boxes(*landmarks, image.width, image.height).lower_face;
    o = {static_cast<int>(box.left), static_cast<int>(box.top), static_cast<int>(box.right - box.left),
         static_cast<int>(box.bottom - box.top)};
  }
  check(o.left_px >= 0 && o.top_px >= 0 && o.width_px > 0 && o.height_px > 0 && o.left_px + o.width_px <= image.width &&
            o.top_px + o.height_px <= image.height,
        "the part of ", o.width_px, " x ", o.height_px, " pixels at ", o.left_px, ", ", o.top_px,
        " does not lie within the picture of ", image.width, " x ", image.height);
  return image_part(image, o.left_px, o.top_px, o.width_px, o.height_px);
}

}  // namespace face::mmm
