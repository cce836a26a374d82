// SPDX-License-Identifier: Apache-2.0
#pragma once
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
  // dots, lost: null = none. samples: per pixel and axis, for mean_of. rig, opaque and lost must outlive the view.
  ScannerView(const Rig& rig, const OpaqueTriangles& opaque, const Moment& moment, const Camera& camera,
              PictureSize picture, const Camera& projector, PictureSize pattern, const SurfaceDots* dots,
              const VertexMask* lost, int samples = 1);

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
  // The mean of light(const SeenPoint&) over a pixel's area, by samples x samples places in it; background where one
  // sees nothing.
  template <class Light>
  float mean_of(int x, int y, float background, Light light) const {
    SeenPoint seen;
    float sum = 0;
    for (int i = 0; i < samples_; ++i)
      for (int k = 0; k < samples_; ++k) {
        const int column = x * samples_ + k, row = y * samples_ + i;
        const bool covered = see(fine_.triangles[fine_.index(column, row)], place_of(column), place_of(row), seen);
        sum += covered ? light(seen) : background;
      }
    return sum / static_cast<float>(samples_ * samples_);
  }
  SurfaceMap map() const { return map_of(raster_, screen_, opaque_); }

 private:
  // What is at a place of the picture where this triangle, -1 for none, is the nearest; all but the pixel.
  bool see(std::int32_t triangle, float x_px, float y_px, SeenPoint& seen) const;
  // Where in the picture a column or row of the samples lies.
  float place_of(int sample) const { return (static_cast<float>(sample) + 0.5f) / static_cast<float>(samples_) - 0.5f; }
  bool is_lit(const render::ScreenPoint& at) const;

  const OpaqueTriangles& opaque_;
  const VertexMask* lost_;
  std::vector<Vec3f> points_mm_, normals_, albedo_;  // V
  std::vector<Vec3f> part_albedo_;                   // linear
  render::MouthLight mouth_;
  std::vector<render::ScreenPoint> screen_;
  render::Raster raster_, fine_, pattern_;  // fine_: of the samples, empty for one
  Camera camera_, projector_;
  DotPainter dots_;
  int samples_;
};

// 1 / depth at every pixel of a head as the camera sees it at a moment; 0 where there is nothing.
std::vector<float> inverse_depths(const Rig& rig, const OpaqueTriangles& opaque, const Moment& moment,
                                  const Camera& camera, PictureSize picture);

// Whether something at this place of a raster and this depth is seen: not farther than the farthest of the four pixels
// about it, and tolerance_mm. So a surface does not hide itself, however steep.
bool is_seen(const render::Raster& raster, const render::ScreenPoint& at, float tolerance_mm);

}  // namespace face::phantom
