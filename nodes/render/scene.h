// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/render/camera.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/shade.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::render {

// A posed head, ready to be rasterised and shaded.
struct Scene {
  struct Material {
    Vec3f albedo = {0.6f, 0.6f, 0.6f};  // linear
    float gloss = 0.2f;
    float scatter = 0;  // as Surface::scatter
  };
  std::vector<Vec3f> points_mm;     // V
  std::vector<Vec3f> normals;       // V
  std::vector<Vec3f> tint;          // V, linear vertex colours; empty = white
  std::vector<float> exposure;      // V, as Surface::exposure
  std::vector<float> opacity;       // V, of the lashes; 1 elsewhere
  std::vector<Material> materials;  // per part, at least one
  Triangulation opaque;
  Triangulation lashes;             // drawn over the rest, thin and half transparent
  std::vector<ScreenPoint> screen;  // V
  Vec3f eye_mm = {0, 0, 0};
};

// Poses the rig and sees it through the camera; exposure holds the mouth's only (mouth_light.h).
Scene make_scene(const Rig& rig, const Weights& weights, const Camera& camera, const SrgbTable& srgb);

// Darkens exposure where nearer surfaces stand around a vertex: the corners of the eyes, beside the nose, under the chin.
// Every vertex that faces the camera looks at the depth picture along 6 directions at 4 distances (the obscurance of
// McGuire et al., The Alchemy Screen-Space Ambient Obscurance Algorithm, HPG 2011, eq. 10).
// Differs from the paper: evaluated at vertices, so it is smooth and costs nothing per pixel; the samples do not vary.
void add_screen_occlusion(const Raster& raster, const Camera& camera, Scene& scene);

}  // namespace face::render
