// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/phantom/dot_painter.h"
#include "nodes/phantom/exposures.h"
#include "nodes/phantom/head_view.h"
#include "nodes/render/mouth_light.h"
#include "nodes/render/rasterize.h"
#include "nodes/types/camera.h"
#include "nodes/types/rig.h"
#include "nodes/types/surface_dots.h"
#include "nodes/types/vertex_mask.h"

namespace face::phantom {

struct PictureSize {
  int width_px = 0;
  int height_px = 0;
};

// What a scanner's camera sees through one pixel, and how its projector lights it. Places and directions are in the
// head's frame.
struct SeenPoint {
  std::size_t pixel = 0;
  float depth_mm = 0;          // along the camera's axis
  Vec3f albedo = {0, 0, 0};    // linear
  float camera_cosine = 0;     // of the angle between normal and camera, >= 0
  float projector_cosine = 0;  // of the angle between normal and projector; < 0: turned away from it
  float projector_x_px = 0;    // where the projector sees it
  float ambient = 1;           // share of the surroundings' light that arrives: less in the mouth
  float lost = 0;              // the lost mask there, in [0, 1]
  bool lit = false;            // within the projector's picture and not in a shadow
};

// The luminance of Lighting, of linear light.
inline float luminance(const Vec3f& colour) { return 0.3f * colour[0] + 0.59f * colour[1] + 0.11f * colour[2]; }

// A head at one moment in front of a camera and a projector.
class ScannerView {
 public:
  // dots, lost: null = none. rig, opaque and lost must outlive the view.
  ScannerView(const Rig& rig, const OpaqueTriangles& opaque, const Moment& moment, const Camera& camera,
              PictureSize picture, const Camera& projector, PictureSize pattern, const SurfaceDots* dots,
              const VertexMask* lost);

  // Looks through the centre of every covered pixel, rows from the top; look(const SeenPoint&).
  template <class Look>
  void for_each(Look look) const {
    SeenPoint seen;
    for (int y = 0; y < raster_.height_px; ++y)
      for (int x = 0; x < raster_.width_px; ++x)
        if (see(raster_.triangles[raster_.index(x, y)], static_cast<float>(x), static_cast<float>(y), seen)) {
          seen.pixel = raster_.index(x, y);
          look(seen);
        }
  }
  // At every pixel that is marked in where: the mean of light(const SeenPoint&) over its area, by samples x samples
  // places in it; background where one sees nothing. where, values: height x width.
  template <class Light>
  void take_means(const std::vector<std::uint8_t>& where, int samples, float background, Light light,
                  std::vector<float>& values) const {
    render::Raster fine;  // of one band of rows after the other, in the same memory
    for (int top = 0; top < raster_.height_px; top += band_px) {
      const int bottom = std::min(top + band_px, raster_.height_px);
      if (std::find(where.begin() + row(top), where.begin() + row(bottom), 1) == where.begin() + row(bottom)) continue;
      rasterize_band(top, bottom, samples, fine);
      for (int y = top; y < bottom; ++y)
        for (int x = 0; x < raster_.width_px; ++x)
          if (where[raster_.index(x, y)] != 0)
            values[raster_.index(x, y)] = mean_of(x, y, top, samples, fine, background, light);
    }
  }
  SurfaceMap map() const { return map_of(raster_, screen_, opaque_); }

 private:
  static constexpr int band_px = 32;
  // What is at a place of the picture where this triangle, -1 for none, is the nearest; all but the pixel.
  bool see(std::int32_t triangle, float x_px, float y_px, SeenPoint& seen) const;
  // What samples x samples places per pixel see in the rows of pixels [top, bottom).
  void rasterize_band(int top, int bottom, int samples, render::Raster& fine) const;
  template <class Light>
  float mean_of(int x, int y, int top, int samples, const render::Raster& fine, float background, Light light) const {
    const auto place = [&](int pixel, int sample) {
      return static_cast<float>(pixel) + (static_cast<float>(sample) + 0.5f) / static_cast<float>(samples) - 0.5f;
    };
    SeenPoint seen;
    float sum = 0;
    for (int i = 0; i < samples; ++i)
      for (int k = 0; k < samples; ++k) {
        const std::int32_t nearest = fine.triangles[fine.index(x * samples + k, (y - top) * samples + i)];
        sum += see(nearest, place(x, k), place(y, i), seen) ? light(seen) : background;
      }
    return sum / static_cast<float>(samples * samples);
  }
  std::ptrdiff_t row(int y) const { return static_cast<std::ptrdiff_t>(y) * raster_.width_px; }
  bool is_lit(const render::ScreenPoint& at) const;

  const OpaqueTriangles& opaque_;
  const VertexMask* lost_;
  std::vector<Vec3f> points_mm_, normals_, albedo_;  // V
  std::vector<Vec3f> part_albedo_;                   // linear
  render::MouthLight mouth_;
  std::vector<render::ScreenPoint> screen_;
  render::Raster raster_, pattern_;
  Camera camera_, projector_;
  DotPainter dots_;
};

// 1 / depth at every pixel of a head as the camera sees it at a moment; 0 where there is nothing.
std::vector<float> inverse_depths(const Rig& rig, const OpaqueTriangles& opaque, const Moment& moment,
                                  const Camera& camera, PictureSize picture);

// Whether something at this place of a raster and this depth is seen: not farther than the farthest of the four pixels
// about it, and tolerance_mm. So a surface does not hide itself, however steep.
bool is_seen(const render::Raster& raster, const render::ScreenPoint& at, float tolerance_mm);

}  // namespace face::phantom
