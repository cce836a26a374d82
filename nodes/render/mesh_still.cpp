// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/mesh_still.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "nodes/render/points_still.h"
#include "nodes/render/render_head.h"
#include "nodes/types/arkit.h"

namespace face::render {
namespace {

constexpr int side_px = 360;
constexpr double side_yaw_deg = 40;

Image in_a_row(const std::vector<Image>& pictures) {
  Image row{0, side_px, 3, {}};
  for (const Image& picture : pictures) row.width += picture.width;
  row.pixels.resize(static_cast<std::size_t>(row.width) * side_px * 3);
  std::size_t left = 0;
  for (const Image& picture : pictures) {
    const std::size_t bytes = static_cast<std::size_t>(picture.width) * 3;
    for (std::size_t y = 0; y < side_px; ++y)
      std::copy_n(
          picture.pixels.begin() + static_cast<std::ptrdiff_t>(y * bytes), bytes,
          row.pixels.begin() + static_cast<std::ptrdiff_t>((y * static_cast<std::size_t>(row.width) * 3) + left));
    left += bytes;
  }
  return row;
}

RenderHeadOptions options_of(double yaw_deg) {
  RenderHeadOptions options;
  options.width_px = options.height_px = side_px;
  options.yaw_deg = yaw_deg;
  return options;
}

}  // namespace

Image mesh_still(const Mesh& mesh) {
  if (mesh.polygon_count() == 0) return points_still({mesh.points_mm});
  Rig rig;
  rig.neutral = mesh;
  return in_a_row({render_head(rig, {}, options_of(0)), render_head(rig, {}, options_of(side_yaw_deg))});
}

Image rig_still(const Rig& rig) {
  Weights posed;
  const auto set = [&](std::string_view name, float weight) {
    const auto at =
        static_cast<std::size_t>(std::find(arkit_names.begin(), arkit_names.end(), name) - arkit_names.begin());
    if (at >= rig.shapes.size()) return;
    posed.values.resize(std::max(posed.values.size(), at + 1));
    posed.values[at] = weight;
  };
  set("jawOpen", 0.5f);
  set("mouthSmileLeft", 0.6f);
  set("mouthSmileRight", 0.6f);
  return in_a_row({render_head(rig, {}, options_of(0)), render_head(rig, {}, options_of(side_yaw_deg)),
                   render_head(rig, posed, options_of(0))});
}

}  // namespace face::render
