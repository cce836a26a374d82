// SPDX-License-Identifier: Apache-2.0
#pragma once
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
  // dots, lost: null = none. rig and lost must outlive the view.
  ScannerView(const Rig& rig, const OpaqueTriangles& opaque, const Moment& moment, const Camera& camera,
              PictureSize picture, const Camera& projector, PictureSize pattern, const SurfaceDots* dots,
              const VertexMask* lost);

  // Looks at every covered pixel, rows from the top; look(const SeenPoint&).
  template <class Look>
  void for_each(Look look) const {
    SeenPoint seen;
    for (int y = 0; y < raster_.height_px; ++y)
      for (int x = 0; x < raster_.width_px; ++x)
        if (see(x, y, seen)) look(seen);
  }
  SurfaceMap map() const { return map_of(raster_, screen_, opaque_); }

 private:
  bool see(int x, int y, SeenPoint& seen) const;
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
