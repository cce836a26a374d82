// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "nodes/types/camera.h"

namespace face {

// How a camera turns a lit albedo into an sRGB value in [0, 1]: with L_c = ambient_c + parallel_c max(0, n . direction)
// and e_c = srgb(L_c albedo_c), value_c = gain_c (contrast e_c + (1 - contrast) luma(e)) + offset_c.
// To L_c albedo_c skin adds parallel_c times what it mirrors; the maps of texture.extract hold that in their albedo.
struct FaceLight {
  Vec3f ambient = {0.6f, 0.6f, 0.6f};   // linear
  Vec3f parallel = {0.5f, 0.5f, 0.5f};  // linear
  Vec3f direction = {0, 0, 1};          // unit, towards the light, in the camera's frame
  float contrast = 1;                   // of colour: 0 = grey
  Vec3f gain = {1, 1, 1};
  Vec3f offset = {0, 0, 0};
  Vec2f mirror = {0, 0};  // shares of the parallel light in the two lobes that skin mirrors (nodes/model/light_model.h)
};

// A morphable model's coefficients and the circumstances under which one picture shows that face.
struct FaceFit {
  std::vector<float> identity;  // the model's coefficients, not divided by sigma; shorter lists leave the rest 0
  std::vector<float> expression;
  std::vector<float> albedo;
  Camera camera;  // its world is the head's frame
  int image_width_px = 0;
  int image_height_px = 0;
  FaceLight light;
  bool converged = false;
  std::string problem;         // what is wrong and what to do about it; empty where nothing is
  double landmark_rms_px = 0;  // distance of the given points to the model's
  double landmark_nme = 0;     // their mean distance over that of the outer corners of the eyes
  double image_rms = 0;        // difference of picture and model on the better four fifths of the skin, in [0, 1]
  double lip_gap_mm = 0;       // how far the mouth is open, as Rig's lip gap
};

}  // namespace face
