// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/draw_fit.h"

#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/model/pose_model.h"
#include "nodes/render/rgb_image.h"
#include "nodes/texture/posed_face.h"

namespace face::texture {
namespace {

constexpr Vec3f lamp = {-0.35f, 0.35f, 0.87f};  // in the camera's frame

}  // namespace

Image draw_fit(const MorphableModel& model, const FaceFit& fit, const Image& picture, const DrawFitOptions& options) {
  check(picture.width == fit.image_width_px && picture.height == fit.image_height_px, "the picture is ", picture.width,
        " x ", picture.height, " pixels, the fit was made on ", fit.image_width_px, " x ", fit.image_height_px);
  Image result = render::rgb_image(picture);
  const PosedFace face = pose_face(model.mean, model::pose_model(model, fit.identity, fit.expression), fit, 1);
  const auto& r = fit.camera.cam_from_world;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t pixel = face.raster.index(x, y);
      const std::int32_t t = face.raster.triangles[pixel];
      if (t < 0 || !face.skin[static_cast<std::size_t>(t)]) continue;
      const render::Triangle& triangle = face.solid.triangles[static_cast<std::size_t>(t)];
      const Vec3f b = render::barycentrics_at(face.screen, triangle, static_cast<float>(x), static_cast<float>(y));
      float light = 0;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t row = 0; row < 3; ++row)
          for (std::size_t k = 0; k < 3; ++k) light += b[i] * lamp[row] * r[3 * row + k] * face.normals[triangle[i]][k];
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint8_t& value = result.pixels[3 * pixel + c];
        const double grey = 235.0 * std::clamp(light, 0.05f, 1.0f);
        value = static_cast<std::uint8_t>(value + options.opacity * (grey - value));
      }
    }
  return result;
}

}  // namespace face::texture
