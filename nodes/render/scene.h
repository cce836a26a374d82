// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/render/camera.h"
#include "nodes/render/mouth_light.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/shade.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::render {

// What is interpolated over a triangle, in one place per vertex: the four vectors are as the compiler adds them.
struct VertexLook {
  using Four = float __attribute__((vector_size(16)));
  Four light = {0, 0, 0, 0};    // linear diffuse light x tint x exposure; exposure
  Four normal = {0, 0, 0, 0};   // unit; opacity
  Four view_mm = {0, 0, 0, 0};  // from the vertex to the eye; soft highlight, linear, already x exposure
};

// A posed head, ready to be rasterised and shaded.
struct Scene {
  struct Material {
    Vec3f albedo = {0.6f, 0.6f, 0.6f};  // linear
    float gloss = 0.2f;
    float scatter = 0;  // as in diffuse_light
  };
  std::vector<Vec3f> points_mm;     // V
  std::vector<Vec3f> normals;       // V
  std::vector<Vec3f> tint;          // V, linear vertex colours; empty = white
  std::vector<float> exposure;      // V, share of the surroundings seen: 1 outside, towards 0 deep in the mouth
  MouthLight mouth;                 // its exposure is moved to the one above
  std::vector<VertexLook> looks;    // V
  std::vector<float> opacity;       // V, of the lashes; 1 elsewhere
  std::vector<Material> materials;  // per part, at least one
  Triangulation opaque;
  Triangulation lashes;             // drawn over the rest, thin and half transparent
  std::vector<ScreenPoint> screen;  // V
  Vec3f eye_mm = {0, 0, 0};
};

// Poses the rig and sees it through the camera. exposure holds the mouth's only, looks are empty.
Scene make_scene(const Rig& rig, const Weights& weights, const Camera& camera, const SrgbTable& srgb);

// Darkens exposure where nearer surfaces stand around a vertex: the corners of the eyes, beside the nose, under the
// chin. Every vertex that faces the camera looks at the depth picture along 6 directions at 3 distances (the obscurance
// of McGuire et al., The Alchemy Screen-Space Ambient Obscurance Algorithm, HPG 2011, eq. 10). Differs from the paper:
// evaluated at vertices, so it is smooth and costs nothing per pixel; the samples do not vary.
void add_screen_occlusion(const Raster& raster, const Camera& camera, Scene& scene);

// Gloss up to which highlights are so wide that they are found at vertices; above, at every pixel.
inline constexpr float soft_gloss = 0.45f;

// Finds the looks of all vertices, once their exposure is known.
void light_scene(Scene& scene);

}  // namespace face::render
