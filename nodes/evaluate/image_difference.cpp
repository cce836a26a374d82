// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/image_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/evaluate/draw_text.h"
#include "nodes/evaluate/statistics.h"
#include "nodes/render/rgb_image.h"

namespace face::evaluate {

ImageDifferenceResult image_difference(const Image& a, const Image& b) {
  const Image x = render::rgb_image(a), y = render::rgb_image(b);
  const std::vector<std::string> columns = {"rms_levels", "largest_levels", "differing_percent", "psnr_db", "pixels"};
  const bool same_size = x.width == y.width && x.height == y.height;
  const std::size_t pixels = x.pixels.size() / 3;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  constexpr int gap_px = 8;
  Canvas canvas(x.width + gap_px + y.width + (same_size ? gap_px + x.width : 0), std::max({x.height, y.height, 1}));
  canvas.paste(x, 0, 0);
  canvas.paste(y, x.width + gap_px, 0);
  if (!same_size)
    return {one_row("all", columns, {nothing, nothing, nothing, nothing, static_cast<double>(pixels)}), canvas.image()};

  double squares = 0, differing = 0;
  int largest = 0;
  Image apart{x.width, x.height, 3, std::vector<std::uint8_t>(x.pixels.size())};
  for (std::size_t i = 0; i < pixels; ++i) {
    int here = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int d = std::abs(int{x.pixels[3 * i + c]} - int{y.pixels[3 * i + c]});
      squares += double(d) * d;
      here = std::max(here, d);
      apart.pixels[3 * i + c] = static_cast<std::uint8_t>(d);
    }
    differing += here > 0;
    largest = std::max(largest, here);
  }
  if (largest > 0)
    for (std::uint8_t& level : apart.pixels) level = static_cast<std::uint8_t>(255 * level / largest);
  canvas.paste(apart, x.width + gap_px + y.width + gap_px, 0);
  const double rms = pixels > 0 ? std::sqrt(squares / (3 * static_cast<double>(pixels))) : nothing;
  const double psnr = rms == 0 ? std::numeric_limits<double>::infinity() : 20 * std::log10(255 / rms);
  return {one_row("all", columns,
                  {rms, static_cast<double>(largest), percent_of(differing, static_cast<double>(pixels)), psnr,
                   static_cast<double>(pixels)}),
          canvas.image()};
}

}  // namespace face::evaluate
