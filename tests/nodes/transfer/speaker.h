// SPDX-License-Identifier: Apache-2.0
// A speaking person whose truth is known: the mesh of a scan with a slightly open mouth, its neutral frame, and which
// point of the head every vertex is.
#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "nodes/align/fit_axis.h"
#include "nodes/base/pose.h"
#include "nodes/base/random.h"
#include "nodes/base/scan_points.h"
#include "nodes/model/from_rig.h"
#include "nodes/model/sample_scan.h"
#include "nodes/phantom/make_camera.h"
#include "nodes/phantom/make_person.h"
#include "nodes/phantom/surface_map.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/resample.h"
#include "nodes/types/depth_scan.h"

namespace test {

inline face::Weights open_mouth(const face::Rig& rig, float jaw) {
  face::Weights weights;
  for (const face::Shape& shape : rig.shapes) weights.values.push_back(shape.name == "jawOpen" ? jaw : 0.0f);
  return weights;
}

struct Speaker {
  face::Rig person;
  face::DepthScan reference;
  face::Mesh mesh;
  face::MeshPoints rest;    // with a scanner's noise
  face::SurfaceMap places;  // truth
  face::Axis axis;

  Speaker(const face::Rig& rig, const face::ShapeSet& modes, std::int64_t seed, double warp_mm,
          double noise_mm = 0.15) {
    person = face::phantom::make_person(rig, &modes, nullptr, {.seed = seed, .warp_mm = warp_mm}).person;
    const face::Weights weights = open_mouth(person, 0.25f);
    face::phantom::MakeCameraOptions camera;
    camera.width_px = 480;
    camera.height_px = 360;
    camera.target_y_mm = -5;
    camera.field_of_view_deg = 13.5;
    reference.camera = face::phantom::make_camera(camera);
    const face::SurfaceMap seen =
        face::phantom::surface_map(person, weights, nullptr, reference.camera, {.width_px = 480, .height_px = 360});
    const std::vector<face::Vec3f> posed = face::pose_points(person, weights);
    const auto all = face::render::triangulate(person.neutral, false);
    reference.picture = {480, 360, 1, std::vector<std::uint8_t>(480 * 360, 120)};
    reference.depth_mm.assign(480 * 360, 0);
    for (std::size_t i = 0; i < seen.triangle.size(); ++i) {
      if (seen.triangle[i] < 0) continue;
      const auto t = static_cast<std::size_t>(seen.triangle[i]);
      const std::string& part = person.neutral.parts[all.parts[t]].name;
      if (part.find("mouth") != part.npos || part == "gums" || part == "teeth" || part == "tongue" ||
          part.find("teeth") != part.npos)
        continue;
      const auto& w = seen.weights[i];
      face::Vec3f p{};
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = w[0] * posed[all.triangles[t][0]][k] + w[1] * posed[all.triangles[t][1]][k] +
               (1 - w[0] - w[1]) * posed[all.triangles[t][2]][k];
      reference.depth_mm[i] = static_cast<float>(face::pixel_of(reference.camera, p).depth_mm);
    }
    mesh = face::model::scan_mesh(reference);
    places = face::transfer::scan_places(seen, mesh, &person);
    axis = face::align::fit_axis(reference).axis;
    rest = face::transfer::resample(places, person, nullptr, nullptr, mesh, {mesh.points_mm});
    face::Random random(7);
    for (face::Vec3f& p : rest.points_mm)
      for (float& x : p) x += static_cast<float>(noise_mm * random.normal());
  }
};

}  // namespace test
