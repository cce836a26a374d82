// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/draw_heat_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"
#include "nodes/evaluate/draw_text.h"
#include "nodes/evaluate/regions.h"
#include "nodes/render/render_head.h"

namespace face::evaluate {
namespace {

constexpr int picture_px = 480, scale_px = 90;

std::vector<Colour> colours() {
  cv::Mat levels(1, 256, CV_8UC1), bgr;
  for (int i = 0; i < 256; ++i) levels.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(levels, bgr, cv::COLORMAP_JET);
  std::vector<Colour> all;
  for (int i = 0; i < 256; ++i) {
    const auto& c = bgr.at<cv::Vec3b>(0, i);
    all.push_back({c[2], c[1], c[0]});
  }
  return all;
}

}  // namespace

Image draw_heat_map(const Rig& rig, const std::vector<double>& error_mm, double full_scale_mm) {
  check(error_mm.size() == rig.neutral.points_mm.size(), "there are ", error_mm.size(), " errors, the rig has ",
        rig.neutral.points_mm.size(), " vertices");
  for (std::size_t v = 0; v < error_mm.size(); ++v)
    check(std::isfinite(error_mm[v]), "the error of vertex ", v, " is ", error_mm[v], ", expected a finite number");
  const std::vector<Colour> map = colours();
  Rig painted;
  painted.neutral = rig.neutral;
  painted.landmarks68 = rig.landmarks68;
  painted.inner_lips = rig.inner_lips;
  painted.neutral.colors_srgb.assign(error_mm.size(), {0.55f, 0.55f, 0.55f});
  for (Part& part : painted.neutral.parts) {
    part.albedo_srgb = {1, 1, 1};
    part.gloss = 0;
    for (const char* cover : {"hair", "brow", "lash"})
      if (part.name.find(cover) != std::string::npos) part.visible = false;
  }
  for (const std::uint32_t v : skin_vertices(rig)) {
    const double level = std::clamp(error_mm[v] / full_scale_mm, 0.0, 1.0);
    const Colour& colour = map[static_cast<std::size_t>(level * 255)];
    for (std::size_t c = 0; c < 3; ++c) painted.neutral.colors_srgb[v][c] = static_cast<float>(colour[c]) / 255;
  }
  Canvas canvas(2 * picture_px + scale_px, picture_px);
  render::RenderHeadOptions options;
  options.width_px = options.height_px = picture_px;
  options.framing = render::Framing::face;
  canvas.paste(render_head(painted, {}, options), 0, 0);
  options.yaw_deg = 50;
  canvas.paste(render_head(painted, {}, options), picture_px, 0);
  const int x = 2 * picture_px + 12, top = 40, bottom = picture_px - 30;
  for (int y = top; y <= bottom; ++y)
    canvas.fill(x, y, 16, 1, map[static_cast<std::size_t>(255 * (bottom - y) / (bottom - top))]);
  for (const double tick : ticks_between(0, full_scale_mm))
    canvas.text(short_number(tick), {x + 22.0, bottom - (bottom - top) * tick / full_scale_mm + 4}, 9, ink);
  canvas.text("mm", {double(x), 28}, 11, ink);
  return canvas.image();
}

}  // namespace face::evaluate
