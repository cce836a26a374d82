// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/measure_teeth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/model/light_model.h"
#include "nodes/model/pose_model.h"
#include "nodes/render/rgb_image.h"
#include "nodes/texture/continue_background.h"
#include "nodes/texture/draw_face.h"

namespace face::texture {
namespace {

constexpr double open_mm = 2;          // of lips apart, below which teeth are no more than a line
constexpr double beside_mm = 2;        // as far from the drawn opening teeth are looked for: a fit is never exact
constexpr double least_mm2 = 8;        // of teeth seen
constexpr double least_drawn_mm2 = 4;  // and of teeth drawn, to compare with
constexpr double pale = 0.5;           // redness of teeth, the logarithm of red over green, over the skin's: at most
constexpr double bright = 0.75;        // of the skin's brightness: at least
constexpr double skin_mm[] = {8, 25};  // from the opening, where it is skin
constexpr double least_gain = 0.7, most_gain = 2.2;

using Pixel = std::array<double, 3>;

double luma_of(const Pixel& p) { return model::luma[0] * p[0] + model::luma[1] * p[1] + model::luma[2] * p[2]; }

// The mean of the `count` brightest.
Pixel bright_mean(std::vector<Pixel> pixels, std::size_t count) {
  const auto end = pixels.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(pixels.begin(), end, pixels.end(), [](const Pixel& a, const Pixel& b) {
    return luma_of(a) != luma_of(b) ? luma_of(a) > luma_of(b) : a > b;
  });
  Pixel mean{};
  for (auto p = pixels.begin(); p != end; ++p)
    for (std::size_t c = 0; c < 3; ++c) mean[c] += (*p)[c] / static_cast<double>(count);
  return mean;
}

}  // namespace

Matrix measure_teeth(const MorphableModel& model, const Rig& person, const AlbedoMap& albedo, const FaceFit& fit,
                     const Image& picture) {
  check(picture.width == fit.image_width_px && picture.height == fit.image_height_px, "the picture is ", picture.width,
        " x ", picture.height, " pixels, the fit was made on ", fit.image_width_px, " x ", fit.image_height_px);
  Matrix gain{1, 3, {1, 1, 1}};
  if (fit.lip_gap_mm < open_mm) return gain;
  const Image rgb = render::rgb_image(picture);
  const std::vector<Vec3f> points = model::pose_model(model, fit.identity, fit.expression);
  const FaceLayer layer = draw_face(person, albedo, points, points, fit);
  const double scale = face_scale_px(fit);
  cv::Mat away(layer.height, layer.width, CV_8U), distance;
  for (std::size_t i = 0; i < layer.mouth.size(); ++i) away.data[i] = layer.mouth[i] > 0.5f ? 0 : 255;
  if (cv::countNonZero(away) == static_cast<int>(away.total())) return gain;
  cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_5);
  std::vector<double> skin_red, skin_luma;
  std::vector<Pixel> near_mouth, drawn;
  for (std::size_t i = 0; i < layer.mouth.size(); ++i) {
    const double mm = static_cast<double>(distance.ptr<float>()[i]) / scale;
    Pixel seen;
    for (std::size_t c = 0; c < 3; ++c) seen[c] = std::max(1.0, static_cast<double>(rgb.pixels[3 * i + c]));
    if (layer.teeth[i] > 0.9f) {
      Pixel& shown = drawn.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) shown[c] = 255.0 * static_cast<double>(layer.mouth_colour[i][c]);
    }
    if (mm <= beside_mm) near_mouth.push_back(seen);
    if (mm < skin_mm[0] || mm > skin_mm[1] || layer.alpha[i] < 0.9f) continue;
    skin_red.push_back(std::log(seen[0] / seen[1]));
    skin_luma.push_back(luma_of(seen));
  }
  const double red = median(skin_red), luma = median(skin_luma);
  std::erase_if(near_mouth,
                [&](const Pixel& p) { return std::log(p[0] / p[1]) > pale * red || luma_of(p) < bright * luma; });
  const double pixel_mm2 = 1 / (scale * scale);
  if (static_cast<double>(near_mouth.size()) * pixel_mm2 < least_mm2 ||
      static_cast<double>(drawn.size()) * pixel_mm2 < least_drawn_mm2)
    return gain;
  // As many of both, since what is dark was not taken for teeth.
  const std::size_t count = (std::min(near_mouth.size(), drawn.size()) + 1) / 2;
  const Pixel seen = bright_mean(std::move(near_mouth), count), shown = bright_mean(std::move(drawn), count);
  for (std::size_t c = 0; c < 3; ++c)
    gain.values[c] = std::clamp(seen[c] / std::max(1.0, shown[c]), least_gain, most_gain);
  return gain;
}

Vec3f gain_of(const Matrix* teeth) {
  if (teeth == nullptr) return {1, 1, 1};
  check(teeth->rows == 1 && teeth->columns == 3 && teeth->values.size() == 3, "teeth is ", teeth->rows, " x ",
        teeth->columns, ", expected 1 x 3");
  return {static_cast<float>(teeth->values[0]), static_cast<float>(teeth->values[1]),
          static_cast<float>(teeth->values[2])};
}

}  // namespace face::texture
