// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/rig.h"

namespace face::texture {

// A face drawn with a fit's camera and light, to be laid over its picture.
struct FaceLayer {
  int width = 0, height = 0;
  std::vector<Vec3f> colour;        // height x width, sRGB in [0, 1], times alpha
  std::vector<float> alpha;         // how much the drawn face replaces the picture
  std::vector<float> cover;         // how much of the pixel is face, whether drawn or left
  std::vector<Vec3f> mouth_colour;  // of colour, what lies inside the mouth
  std::vector<float> mouth;         // of alpha, the same
  std::vector<float> teeth;         // of that, teeth
  std::vector<Vec2f> shift_px;      // how far what is drawn there has moved, times alpha; 0 above the mouth
};

// How much of a vertex is drawn anew: 1 from the cheeks to the chin and inside the mouth; 0 at the eyes and above, at
// the ears, under the chin and at the neck, which keep the picture (follow_face.h). In between it fades, so that the
// drawing has no edge. person: its 68 landmarks; without them all is 1.
std::vector<float> drawn_share(const Rig& person);

struct DrawFaceOptions {
  int samples = 2;               // per pixel and axis
  Vec3f teeth_gain = {1, 1, 1};  // of the teeth's sRGB values (measure_teeth.h)
};

// points_mm: the person's vertices, posed. was_mm: where they are in the picture. The skin takes its colour from the
// map, everything else from the mesh; the mouth is darker the deeper, as render::mouth_light says.
FaceLayer draw_face(const Rig& person, const AlbedoMap& albedo, const std::vector<Vec3f>& points_mm,
                    const std::vector<Vec3f>& was_mm, const FaceFit& fit, const DrawFaceOptions& options = {});

}  // namespace face::texture
