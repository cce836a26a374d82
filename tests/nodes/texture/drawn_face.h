// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/pose.h"
#include "nodes/model/face_pose.h"
#include "nodes/texture/draw_face.h"
#include "nodes/texture/face_mask.h"
#include "nodes/texture/lay_over.h"
#include "tests/nodes/model/material.h"

namespace test {

using namespace face;

// A fit that is the truth: the mean head before a camera, turned by yaw.
inline FaceFit true_fit(double yaw_deg) {
  const Scene scene = make_scene(yaw_deg, 320, 320);
  FaceFit fit;
  model::FacePose pose = model::pose_of(scene.camera, {0, 0, 0});
  for (std::size_t i = 0; i < 9; ++i) pose.rotation[i] = scene.world_from_head.rotation[i];
  fit.camera = model::camera_of(pose);
  fit.image_width_px = fit.image_height_px = 320;
  fit.identity.assign(head_model().identity.size(), 0.0f);
  fit.albedo.assign(head_model().albedo.size(), 0.0f);
  fit.expression.assign(head_model().expression.size(), 0.0f);
  fit.light.ambient = {0.5f, 0.45f, 0.4f};
  fit.light.parallel = {0.6f, 0.6f, 0.6f};
  fit.light.direction = {0.3f, 0.3f, 0.9055f};
  fit.light.contrast = 0.95f;
  fit.light.offset = {0.01f, 0.01f, 0.02f};
  fit.converged = true;
  return fit;
}

inline Weights rest() {
  Weights weights;
  weights.values.assign(head().shapes.size(), 0.0f);
  return weights;
}

inline Weights open_mouth(float jaw) {
  Weights weights = rest();
  for (std::size_t s = 0; s < weights.values.size(); ++s)
    if (head().shapes[s].name == "jawOpen") weights.values[s] = jaw;
  return weights;
}

// A map of one colour with stripes.
inline AlbedoMap striped_map() {
  AlbedoMap map;
  map.width = map.height = 512;
  map.weight.assign(512 * 512, 1.0f);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x)
      map.albedo.push_back({0.45f + 0.1f * std::sin(0.1f * static_cast<float>(y)), 0.3f,
                            0.2f + 0.05f * std::sin(0.12f * static_cast<float>(x))});
  return map;
}

// That face drawn by these nodes themselves.
inline Image drawn(const FaceFit& fit, const AlbedoMap& map, const Weights& weights) {
  const Image paper = blank(320, 320, 90);
  Rig person = head();
  person.landmarks68.clear();  // drawn whole
  const std::vector<Vec3f> points = pose_points(person, weights);
  return face::texture::lay_over(face::texture::draw_face(person, map, points, points, fit, {.samples = 3}), paper, paper,
                                 face::texture::face_mask(head_model(), fit), 1);
}

}  // namespace test
