// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/paste.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/sample_image.h"
#include "nodes/mmm/check_picture.h"
#include "nodes/mmm/face_boxes.h"

namespace face::mmm {

Image paste_mouth(const Image& head, const Image& mouth, const PasteOptions& o) {
  check_picture(head, "head");
  check_picture(mouth, "mouth");
  check(o.left_px + mouth.width <= head.width && o.top_px + mouth.height <= head.height, "the mouth of ", mouth.width,
        " x ", mouth.height, " pixels at ", o.left_px, ", ", o.top_px, " does not lie within the head of ", head.width,
        " x ", head.height);
  Image made = head;
  for (int y = 0; y < mouth.height; ++y)
    for (int x = 0; x < mouth.width; ++x) {
      double edge = o.feather_px;
      if (o.left_px > 0) edge = std::min(edge, x + 0.5);
      if (o.top_px > 0) edge = std::min(edge, y + 0.5);
      if (o.left_px + mouth.width < head.width) edge = std::min(edge, mouth.width - x - 0.5);
      if (o.top_px + mouth.height < head.height) edge = std::min(edge, mouth.height - y - 0.5);
      const double t = o.feather_px > 0 ? edge / o.feather_px : 1;
      const double share = t * t * (3 - 2 * t);
      for (int c = 0; c < 3; ++c) {
        auto& value = made.pixels[static_cast<std::size_t>(((y + o.top_px) * head.width + x + o.left_px) * 3 + c)];
        const auto put = mouth.pixels[static_cast<std::size_t>((y * mouth.width + x) * 3 + c)];
        value = to_byte(share * put + (1 - share) * value);
      }
    }
  return made;
}

void paste(const engine::Seq<Image>& heads, const engine::Seq<Image>& mouths, const Landmarks* landmarks,
           engine::SeqWriter<Image>& frames, const PasteOptions& options) {
  check(!heads.empty(), "there are no heads, expected at least one");
  PasteOptions placed = options;
  if (landmarks) {
    const FaceBox box = find_face_boxes(*landmarks, heads.at(0)->width, heads.at(0)->height).lower_face;
    placed.left_px = static_cast<int>(box.left);
    placed.top_px = static_cast<int>(box.top);
  }
  std::vector<std::shared_ptr<const Image>> held;
  const std::size_t count = std::min(heads.size(), static_cast<std::size_t>(options.head_frames));
  for (std::size_t i = 0; i < count; ++i) held.push_back(heads.at(i));
  std::size_t frame = 0;
  const std::size_t period = std::max<std::size_t>(2 * count - 2, 1);
  for (const Image& mouth : mouths) {
    const std::size_t phase = frame % period;
    const std::size_t at = phase < count ? phase : period - phase;
    frames.push(mouths.id(frame++), paste_mouth(*held[at], mouth, placed));
  }
}

}  // namespace face::mmm
