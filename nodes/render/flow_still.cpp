// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/flow_still.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nodes/base/check.h"

namespace face::render {
namespace {

// Of HSV with full value. hue in [0, 6), saturation in [0, 1].
void set_colour(double hue, double saturation, std::uint8_t* rgb) {
  for (int c = 0; c < 3; ++c) {
    const double k = std::fmod(5.0 - 2 * c + hue, 6.0);
    const double level = 1 - saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    rgb[c] = static_cast<std::uint8_t>(std::lround(255 * level));
  }
}

}  // namespace

Image flow_still(const FlowField& flow) {
  const auto pixels = static_cast<std::size_t>(flow.width) * static_cast<std::size_t>(flow.height);
  check(flow.displacement_px.size() == pixels && flow.valid.size() == pixels, "the flow of ", flow.width, " x ",
        flow.height, " pixels has ", flow.displacement_px.size(), " displacements and ", flow.valid.size(), " flags");
  std::vector<double> lengths;
  const auto known = [&](std::size_t i) {
    return flow.valid[i] && std::isfinite(flow.displacement_px[i][0]) && std::isfinite(flow.displacement_px[i][1]);
  };
  for (std::size_t i = 0; i < pixels; ++i)
    if (known(i)) lengths.push_back(std::hypot(double(flow.displacement_px[i][0]), double(flow.displacement_px[i][1])));
  double full = 1e-9;
  if (!lengths.empty()) {
    const auto at = lengths.begin() + static_cast<std::ptrdiff_t>((lengths.size() - 1) * 99 / 100);
    std::nth_element(lengths.begin(), at, lengths.end());
    full = std::max(full, *at);
  }
  Image image{flow.width, flow.height, 3, {}};
  image.pixels.assign(pixels * 3, 0);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!known(i)) continue;
    const double x = flow.displacement_px[i][0], y = flow.displacement_px[i][1];
    const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
    set_colour(6 * (turn < 0 ? turn + 1 : turn), std::min(1.0, std::hypot(x, y) / full), &image.pixels[3 * i]);
  }
  return image;
}

}  // namespace face::render
