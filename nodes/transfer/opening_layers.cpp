// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/opening_layers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/base/luma.h"
#include "nodes/base/srgb.h"
#include "nodes/transfer/pixel_lens.h"

namespace face::transfer {
namespace {

constexpr double reach_below = 0.25;  // how far an eye goes on below a lid, share of the opening's length
constexpr int blur_px = 8;            // a pixel at the outline sees less than half as far

double light_of(double grey) { return linear_of(std::clamp(grey, 0.0, 255.0) / 255); }
double grey_of(double light) { return 255 * srgb_of(std::max(light, 0.0)); }

std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

// Takes a picture apart at an outline.
class LayerParter {
 public:
  LayerParter(const Image& picture, const Outline& outline)
      : outline_(outline),
        picture_{picture.width, picture.height, 1, {}},
        reach_(static_cast<int>(std::lround(reach_below * opening_axis(outline).length))) {
    for (std::size_t i = 0; i < picture.pixels.size(); i += static_cast<std::size_t>(picture.channels)) {
      const std::uint8_t* p = picture.pixels.data() + i;
      picture_.pixels.push_back(static_cast<std::uint8_t>(std::lround(grey_value<double>(p, picture.channels))));
    }
    const Box box = box_of(outline);
    left_ = std::max(static_cast<int>(box.left) - blur_px, 0);
    top_ = std::max(static_cast<int>(box.top) - blur_px, 0);
    right_ = std::min(static_cast<int>(box.right) + blur_px + 1, picture.width - 1);
    bottom_ = std::min(static_cast<int>(box.bottom) + blur_px + 1, picture.height - 1);
    for (int y = top_; y <= bottom_; ++y)
      for (int x = left_; x <= right_; ++x) eye_shares_.push_back(eye_share(x, y));
  }

  OpeningLayers layers() const {
    Image skin = picture_, eye = picture_;
    for (int y = top_; y <= bottom_; ++y)
      for (int x = left_; x <= right_; ++x) {
        free_pixel(x, y, skin, eye);
        make_whole(x, y, skin, eye);
      }
    return {GreySpline(skin), GreySpline(eye)};
  }

 private:
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x);
  }

  // How much of a pixel is eye.
  double eye_share(int x, int y) const {
    const double away = outline_.distance({static_cast<double>(x), static_cast<double>(y)});
    if (std::fabs(away) >= 0.5 * lens_window / parts_per_px * 1.5) return away < 0 ? 1 : 0;
    double share = 0;
    for (int j = 0; j < lens_window; ++j)
      for (int i = 0; i < lens_window; ++i) {
        const Place part = {x + (i - 0.5 * (lens_window - 1)) / parts_per_px,
                            y + (j - 0.5 * (lens_window - 1)) / parts_per_px};
        if (outline_.distance(part) < 0)
          share += lens_weights()[static_cast<std::size_t>(i)] * lens_weights()[static_cast<std::size_t>(j)];
      }
    return share;
  }
  double share_at(int x, int y) const {
    return eye_shares_[static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(right_ - left_ + 1) +
                       static_cast<std::size_t>(x - left_)];
  }

  // The grey of the nearest pixels that see one layer alone; < 0 where there are none.
  double nearest(int x, int y, bool of_eye) const {
    double least = 1e30, sum = 0, weights = 0;
    for (const bool measure : {true, false})
      for (int ny = std::max(y - reach_, top_); ny <= std::min(y + reach_, bottom_); ++ny)
        for (int nx = std::max(x - reach_, left_); nx <= std::min(x + reach_, right_); ++nx) {
          if (of_eye ? share_at(nx, ny) < 1 - no_share : share_at(nx, ny) > no_share) continue;
          const double away = std::hypot(nx - x, ny - y);
          if (measure) {
            least = std::min(least, away);
          } else if (away < least + 0.8) {
            const double weight = std::exp(-4 * (away - least) * (away - least));
            sum += weight * picture_.pixels[pixel(nx, ny)];
            weights += weight;
          }
        }
    return weights > 0 ? sum / weights : -1.0;
  }

  // What a pixel shows less what it sees of the other layer; the less is left of it, the more it is as its neighbours.
  static double freed(double light, double other_share, double own, double other) {
    if (other_share >= 0.5 || other < 0) return own;
    const double rest = grey_of(std::clamp((light - other_share * light_of(other)) / (1 - other_share), 0.0, 1.0));
    const double known = own < 0 ? 1 : std::clamp((0.5 - other_share) / 0.2, 0.0, 1.0);
    return known * rest + (1 - known) * own;
  }

  // Frees each layer of the other's light.
  void free_pixel(int x, int y, Image& skin, Image& eye) const {
    const std::size_t i = pixel(x, y);
    const double share = share_at(x, y), light = light_of(picture_.pixels[i]);
    const double near_skin = share > no_share ? nearest(x, y, false) : -1;
    const double near_eye = nearest(x, y, true);
    if (share > no_share) {
      const double own = freed(light, share, near_skin, near_eye);
      if (own >= 0) skin.pixels[i] = to_byte(own);
    }
    if (share < 1 - no_share) {
      const double own = freed(light, 1 - share, near_eye, near_skin >= 0 ? near_skin : picture_.pixels[i]);
      if (own >= 0) eye.pixels[i] = to_byte(own);
    }
  }

  // Together the layers are the picture: what has the larger share takes what is left.
  void make_whole(int x, int y, Image& skin, Image& eye) const {
    const std::size_t i = pixel(x, y);
    const double share = share_at(x, y), light = light_of(picture_.pixels[i]);
    if (share <= 0.001 || share >= 0.999) return;
    const double skin_light = light_of(skin.pixels[i]), eye_light = light_of(eye.pixels[i]);
    if (share >= 0.3)
      eye.pixels[i] = to_byte(grey_of(std::clamp((light - (1 - share) * skin_light) / share, 0.0, 1.0)));
    else
      skin.pixels[i] = to_byte(grey_of(std::clamp((light - share * eye_light) / (1 - share), 0.0, 1.0)));
  }

  const Outline& outline_;
  Image picture_;  // grey
  int reach_, left_ = 0, top_ = 0, right_ = 0, bottom_ = 0;
  std::vector<double> eye_shares_;
};

}  // namespace

OpeningLayers opening_layers(const Image& picture, const Outline& outline) {
  return LayerParter(picture, outline).layers();
}

}  // namespace face::transfer
