// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/shape_sheet.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/render/make_contact_sheet.h"
#include "nodes/types/arkit.h"

namespace face::render {
namespace {

Image side_by_side(const Image& left, const Image& right) {
  Image both{left.width + right.width, left.height, 3, {}};
  const auto left_row = static_cast<std::ptrdiff_t>(left.width) * 3,
             right_row = static_cast<std::ptrdiff_t>(right.width) * 3;
  for (std::ptrdiff_t y = 0; y < left.height; ++y) {
    both.pixels.insert(both.pixels.end(), left.pixels.begin() + y * left_row, left.pixels.begin() + (y + 1) * left_row);
    both.pixels.insert(both.pixels.end(), right.pixels.begin() + y * right_row,
                       right.pixels.begin() + (y + 1) * right_row);
  }
  return both;
}

bool lacks(const Rig& rig, std::string_view shape) {
  return std::find(rig.missing.begin(), rig.missing.end(), shape) != rig.missing.end();
}

std::string note_about(std::string_view shape, const Rig& rig, const Rig* beside) {
  const bool first = lacks(rig, shape), second = beside && lacks(*beside, shape);
  if (first && (second || !beside)) return "missing";
  if (first) return "missing on the left";
  if (second) return "missing on the right";
  return shape == "mouthClose" ? "with jawOpen" : "";
}

}  // namespace

Image shape_sheet(const Rig& rig, const Rig* beside, const ShapeSheetOptions& options) {
  check(options.picture_px > 0, "picture_px is ", options.picture_px, ", expected at least 1");
  RenderHeadOptions view;
  view.width_px = view.height_px = options.picture_px;
  view.yaw_deg = options.yaw_deg;
  view.framing = options.framing;
  const auto picture_of = [&](const Weights& weights) {
    const Image picture = render_head(rig, weights, view);
    return beside ? side_by_side(picture, render_head(*beside, weights, view)) : picture;
  };
  std::vector<Image> pictures = {picture_of({})};
  std::vector<Caption> captions = {{"neutral", ""}};
  for (std::size_t shape = 0; shape < arkit_count; ++shape) {
    Weights weights;
    weights.values.assign(arkit_count, 0.0f);
    weights.values[shape] = 1;
    if (arkit_names[shape] == "mouthClose") weights.values[arkit_index("jawOpen")] = 1;
    pictures.push_back(picture_of(weights));
    captions.push_back({std::string(arkit_names[shape]), note_about(arkit_names[shape], rig, beside)});
  }
  return make_contact_sheet(pictures, captions, options.columns);
}

}  // namespace face::render
