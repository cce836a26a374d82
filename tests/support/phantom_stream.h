// SPDX-License-Identifier: Apache-2.0
// Frames of the phantom's structured-light scanner as graphs/phantom/scan_stream.json makes them, pose by pose, with
// the truth of every pixel: for tests of what follows the scanner.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "nodes/base/pose.h"
#include "nodes/base/scan_points.h"
#include "nodes/phantom/make_camera.h"
#include "nodes/phantom/make_head.h"
#include "nodes/phantom/make_person.h"
#include "nodes/phantom/scan_frame.h"
#include "nodes/phantom/truth_flow.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/landmarks.h"

namespace test {

class PhantomStream {
 public:
  explicit PhantomStream(int width = 640, int height = 480) : width_(width), height_(height) {
    face::phantom::MakePersonOptions person;
    person.spread = 0;
    person.markers = face::phantom::Markers::white;
    person.lipstick = true;
    person_ = face::phantom::make_person(face::phantom::make_head(), nullptr, nullptr, person);
    face::phantom::MakeCameraOptions camera_options;
    camera_options.width_px = width;
    camera_options.height_px = height;
    camera_options.target_y_mm = -5;
    camera_options.field_of_view_deg = 13.5;
    camera = face::phantom::make_camera(camera_options);
    camera_options.width_px = 1024;
    camera_options.height_px = 768;
    camera_options.yaw_deg = -17;
    camera_options.field_of_view_deg = 16;
    projector = face::phantom::make_camera(camera_options);
    const auto triangulation = face::render::triangulate(person_.person.neutral, false);
    triangles_ = triangulation.triangles;
    parts_ = triangulation.parts;
  }

  face::Camera camera, projector;
  face::phantom::ScanFrameOptions options;  // faults of the scanner
  const face::Rig& rig() const { return person_.person; }
  const face::SurfaceDots& markers() const { return person_.markers; }
  const std::vector<face::render::Triangle>& triangles() const { return triangles_; }

  face::Weights weights(const std::map<std::string, float>& pose) const {
    face::Weights out;
    for (const face::Shape& shape : rig().shapes) {
      const auto found = pose.find(shape.name);
      out.values.push_back(found == pose.end() ? 0.0f : found->second);
    }
    return out;
  }

  struct Frame {
    face::DepthScan scan;
    face::SurfaceMap truth;
    face::Weights weights;
    face::RigidMotion motion;
  };

  Frame frame(const face::Weights& weights, const face::RigidMotion& motion = {}, const std::string& id = "0") const {
    face::phantom::ScanFrameOptions o = options;
    o.width_px = width_;
    o.height_px = height_;
    const engine::Window<face::Weights> w({std::make_shared<const face::Weights>(weights)}, 0);
    const engine::Window<face::RigidMotion> m({std::make_shared<const face::RigidMotion>(motion)}, 0);
    auto result = face::phantom::scan_frame(rig(), w, m, camera, projector, &person_.dots, nullptr, &id, o);
    return {std::move(result.scan), std::move(result.truth), weights, motion};
  }

  face::FlowField truth_flow(const Frame& from, const Frame& to) const {
    return face::phantom::truth_flow(rig(), from.truth, to.truth, to.weights, &to.motion, camera);
  }

  // Name of the part that a pixel shows; empty for the background.
  std::string part(const Frame& frame, std::size_t pixel) const {
    const int t = frame.truth.triangle[pixel];
    if (t < 0) return {};
    return rig().neutral.parts[parts_[static_cast<std::size_t>(t)]].name;
  }

  // Where the markers' centres are in a frame; valid where the frame shows their triangle's neighbourhood.
  face::Landmarks marker_truth(const Frame& frame) const {
    std::vector<face::Vec3f> posed = face::pose_points(rig(), frame.weights);
    face::Landmarks out;
    for (const face::SurfaceDot& dot : person_.markers.dots) {
      face::Vec3f p{}, moved{};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += dot.weights[k] * posed[dot.vertices[k]][axis];
      for (std::size_t r = 0; r < 3; ++r) {
        double sum = frame.motion.translation_mm[r];
        for (std::size_t c = 0; c < 3; ++c) sum += frame.motion.rotation[r * 3 + c] * static_cast<double>(p[c]);
        moved[r] = static_cast<float>(sum);
      }
      const face::ScanPixel at = face::pixel_of(camera, moved);
      out.points.push_back({dot.name, at.x_px, at.y_px, true});
    }
    return out;
  }

 private:
  int width_, height_;
  face::phantom::MakePersonResult person_;
  std::vector<face::render::Triangle> triangles_;
  std::vector<std::uint16_t> parts_;
};

}  // namespace test
