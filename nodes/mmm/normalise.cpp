// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/normalise.h"

#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/base/image_part.h"
#include "nodes/flow/image_channels.h"
#include "nodes/flow/robust_flow.h"
#include "nodes/mmm/check_picture.h"
#include "nodes/mmm/crop.h"
#include "nodes/mmm/refine_perspective.h"

namespace face::mmm {
namespace {

// H for pixels p = scale q + offset of q's.
Matrix rescale(const Matrix& h, double scale, double offset_x, double offset_y) {
  // S H S^-1 with S = [s 0 a; 0 s b; 0 0 1].
  const double s[9] = {scale, 0, offset_x, 0, scale, offset_y, 0, 0, 1};
  const double t[9] = {1 / scale, 0, -offset_x / scale, 0, 1 / scale, -offset_y / scale, 0, 0, 1};
  Matrix made{3, 3, std::vector<double>(9, 0)};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) made.at(r, c) += s[3 * r + i] * h.at(i, j) * t[3 * j + c];
  const double last = made.at(2, 2);
  for (double& value : made.values) value /= last;
  return made;
}

}  // namespace

FitPerspectiveResult normalise(const Image& reference, const Image& frame, const Image* mask,
                               const NormaliseOptions& options) {
  check_picture(reference, "reference");
  check_size(frame, "frame", reference, "reference");
  CropOptions box{0, 0, reference.width, reference.height};
  if (mask) {
    check(mask->width == reference.width && mask->height == reference.height, "mask is ", mask->width, " x ",
          mask->height, " pixels, reference is ", reference.width, " x ", reference.height);
    check(mask->pixels.size() == static_cast<std::size_t>(mask->width) * static_cast<std::size_t>(mask->height) *
                                     static_cast<std::size_t>(mask->channels),
          "mask has ", mask->pixels.size(), " values, expected ", mask->width, " x ", mask->height, " pixels of ",
          mask->channels, " channels");
    int left = mask->width, top = mask->height, right = -1, bottom = -1;
    for (int y = 0; y < mask->height; ++y)
      for (int x = 0; x < mask->width; ++x)
        if (mask->pixels[static_cast<std::size_t>((y * mask->width + x) * mask->channels)] >= 128)
          left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    if (right < 0) return fit_points({}, {});
    const int margin = reference.width / 16;
    left = std::max(0, left - margin), top = std::max(0, top - margin);
    right = std::min(mask->width - 1, right + margin), bottom = std::min(mask->height - 1, bottom + margin);
    box = {left, top, right - left + 1, bottom - top + 1};
  }
  Image before = crop(reference, nullptr, box), after = crop(frame, nullptr, box),
        within = mask ? crop(*mask, nullptr, box) : Image{};
  const Image whole_before = before, whole_after = after, whole_within = within;
  double scale = 1, offset = 0;
  if (options.half_size && box.width_px >= 32 && box.height_px >= 32) {
    before = halve_image(before), after = halve_image(after);
    if (mask) within = halve_image(within);
    scale = 2, offset = 0.5;
  }
  flow::RobustFlowOptions flow_options;
  flow_options.levels = options.levels;
  flow_options.coarse_warps = options.coarse_warps;
  flow_options.fine_warps = options.fine_warps;
  const FlowField moved = flow::robust_flow(flow::image_channels(before, nullptr), flow::image_channels(after, nullptr),
                                            nullptr, flow_options);
  FitPerspectiveOptions fit_options;
  fit_options.outlier_px = options.outlier_px / scale;
  FitPerspectiveResult result = fit_perspective(moved, mask ? &within : nullptr, fit_options);
  // To the pixels of the box, then to those of the picture.
  result.target_from_reference = rescale(result.target_from_reference, scale, offset, offset);
  if (options.refine && result.solved)
    result.target_from_reference =
        refine_perspective(whole_before, whole_after, mask ? &whole_within : nullptr, result.target_from_reference);
  result.target_from_reference = rescale(result.target_from_reference, 1, 1.0 * box.left_px, 1.0 * box.top_px);
  result.rms_px *= scale;
  return result;
}

}  // namespace face::mmm
