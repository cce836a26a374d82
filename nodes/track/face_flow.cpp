// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/face_flow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/check_image.h"
#include "nodes/base/image_part.h"
#include "nodes/flow/image_channels.h"
#include "nodes/flow/robust_flow.h"

namespace face::track {
namespace {

void check_alike(const Image& image, const std::string& name, const Image& frame) {
  check_image(image, name);
  check(image.width == frame.width && image.height == frame.height && image.channels == frame.channels, name, " is ",
        image.width, " x ", image.height, " pixels of ", image.channels, " channels, the frame is ", frame.width, " x ",
        frame.height, " of ", frame.channels);
}

struct Box {
  int left, top, right, bottom;  // the last two are the first pixels beyond
};

Box box_of(const Landmarks& start, const Image& frame, double margin) {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
  for (const Landmark& point : start.points) {
    if (!point.valid) continue;
    check(std::isfinite(point.x_px) && std::isfinite(point.y_px), "start point ", point.name, " is at (", point.x_px,
          ", ", point.y_px, "), expected finite numbers");
    left = std::min(left, point.x_px), right = std::max(right, point.x_px);
    top = std::min(top, point.y_px), bottom = std::max(bottom, point.y_px);
  }
  if (right < left) return {0, 0, 0, 0};
  // 16 px more hold what is needed about few points that lie close together.
  const double more = 16 + margin * std::max(right - left, bottom - top);
  const auto within = [](double value, int most) { return static_cast<int>(std::clamp(value, 0.0, 1.0 * most)); };
  // Even, so that halves of the box are halves of the picture.
  return {within(left - more, frame.width) / 2 * 2, within(top - more, frame.height) / 2 * 2,
          within(right + more + 1, frame.width) / 2 * 2, within(bottom + more + 1, frame.height) / 2 * 2};
}

}  // namespace

FlowField face_flow(const engine::Window<Image>& frames, const Landmarks& start, const Image* reference,
                    const FaceFlowOptions& options) {
  const Image& frame = frames.centre();
  check_image(frame, "the frame");
  const Image* from = reference;
  if (!from && frames.centre_index() > 0) from = &frames[frames.centre_index() - 1];
  if (from) check_alike(*from, reference ? "reference" : "the previous frame", frame);
  const Box box = box_of(start, frame, options.margin);
  const int scale = options.half_size ? 2 : 1;
  FlowField flow{frame.width / scale, frame.height / scale, {}, {}};
  const std::size_t count = static_cast<std::size_t>(flow.width) * static_cast<std::size_t>(flow.height);
  flow.displacement_px.assign(count, Vec2f{0, 0});
  flow.valid.assign(count, 0);
  const int width = box.right - box.left, height = box.bottom - box.top;
  if (width < 2 * scale || height < 2 * scale) return flow;
  const auto channels = [&](const Image& image) {
    const Image part = image_part(image, box.left, box.top, width, height);
    return flow::image_channels(options.half_size ? halve_image(part) : part, nullptr);
  };
  FlowField found;
  if (from) {
    flow::RobustFlowOptions robust;
    robust.levels = options.levels;
    robust.coarse_warps = options.coarse_warps;
    robust.fine_warps = options.fine_warps;
    found = flow::robust_flow(channels(*from), channels(frame), nullptr, robust);
  }
  for (int y = 0; y < height / scale; ++y)
    for (int x = 0; x < width / scale; ++x) {
      const std::size_t at = static_cast<std::size_t>(y + box.top / scale) * static_cast<std::size_t>(flow.width) +
                             static_cast<std::size_t>(x + box.left / scale);
      flow.valid[at] = 1;
      if (!from) continue;
      const std::size_t in =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(found.width) + static_cast<std::size_t>(x);
      flow.valid[at] = found.valid[in];
      for (std::size_t axis = 0; axis < 2; ++axis)
        flow.displacement_px[at][axis] = std::round(64 * found.displacement_px[in][axis]) / 64;
    }
  return flow;
}

}  // namespace face::track
