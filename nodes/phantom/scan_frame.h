// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/camera.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/surface_dots.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/vertex_mask.h"
#include "nodes/types/weights.h"

namespace face::phantom {

// Pixels that differ more from one beside them are an edge, in steps of 8 bits.
inline constexpr float edge_levels = 3;

// Every fault is off at the value that its comment names.
struct ScanFrameOptions {
  int width_px = 640;
  int height_px = 480;
  int projector_width_px = 1024;
  int projector_height_px = 768;
  bool shadow_holes = true;      // false: what the projector does not light is measured nevertheless
  double noise_mm = 0.15;        // standard deviation of depth where the surface faces camera and projector; 0
  double grazing = 1;            // how much noise grows with the angle; 0
  double max_angle_deg = 78;     // steeper surfaces are not measured; 90
  double min_signal = 0.012;     // darker surfaces are not measured: albedo times cosine towards the projector; 0
  double dropouts = 0.002;       // share of the pixels that are lost without a reason; 0
  double depth_step_mm = 0.05;   // depth comes in multiples of it; 0
  double exposure_step = 0.2;    // frames between two of the five pictures; 0: the head stands still meanwhile
  double ripple = 0.5;           // of the depth that the surface moves between two pictures; 0
  double ripple_period_px = 32;  // of the fringes, in the projector
  double max_motion_mm = 4;      // a pixel whose depth changes more during the five pictures is lost
  int samples = 3;               // per pixel and axis of the picture, where it has edges; 1
  double lens_px = 0.5;          // standard deviation of the lens's blur of the picture; 0
  double exposure = 0.85;        // light in the picture of a white surface that faces the projector, of 1
  double ambient = 0.12;         // light beside the projector's
  bool light = true;             // false: the picture shows the surface's own grey, as without light and shade
  double grey_noise = 1.5;       // standard deviation of the picture, in 1/255; 0
  std::int64_t seed = 1;
};

struct ScanFrameResult {
  DepthScan scan;
  SurfaceMap truth;  // of the middle picture
};

// One frame of a structured-light scanner: a camera and, to its side, a projector (METHODS 1.1, figure 1 of the paper).
// What holes it has, and why: not lit by the projector, or hidden from the camera; too steep; too dark; moved during
// the five pictures; dropouts; lost before (see lose_points).
// Depth is what five pictures at equal intervals show: the mean over them, with the ripple of a phase that moves while
// it is measured, ripple * (depth moved per picture) * sin(2 phase), which is what a steady motion does to phase
// shifting (Weise, Leibe, Van Gool: Fast 3D Scanning with Automatic Motion Compensation, CVPR 2007, section 3); then
// normal noise of noise_mm * (1 + grazing * (1 / cosine - 1)), with the smaller of the cosines towards camera and
// projector, at least 0.1; then rounding to depth_step_mm. The picture is grey, sRGB, in even light from the projector;
// where neighbours differ by more than edge_levels a pixel is the mean light over its area, as of a sensor, and
// elsewhere what its centre sees. Without light it is the albedo's luminance, the same in every frame, so that textures
// can be compared. weights, world_from_head: the frame and one on either side. dots, lost, id: may be null.
ScanFrameResult scan_frame(const Rig& rig, const engine::Window<Weights>& weights,
                           const engine::Window<RigidMotion>& world_from_head, const Camera& camera,
                           const Camera& projector, const SurfaceDots* dots, const VertexMask* lost,
                           const std::string* id, const ScanFrameOptions& options = {});

}  // namespace face::phantom
