// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/mesh.h"

namespace face::texture {

// A face in front of a fit's camera: everything that drawing it and reading its colours off a picture need.
struct PosedFace {
  std::vector<Vec3f> points_mm;  // V
  std::vector<Vec3f> normals;    // V, of the skin and of everything else by itself
  std::vector<float> parallel;   // V, share of the parallel light times the cosine, 0 where it does not shine
  render::Triangulation solid;   // what hides: no hair, brows or lashes
  std::vector<bool> skin;        // per triangle of solid
  std::vector<render::ScreenPoint> screen;  // V, in the fit's picture times `factor`
  render::Raster raster;                    // of solid
};

PosedFace pose_face(const Mesh& mesh, std::vector<Vec3f> points_mm, const FaceFit& fit, int factor);

}  // namespace face::texture
