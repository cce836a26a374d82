// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/rig.h"
#include "nodes/types/surface_dots.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/weights.h"

namespace face::phantom {

// Every fault is off at the value that its comment names.
struct LaserScanOptions {
  int rows = 512;
  int columns = 512;
  double top_mm = 160;
  double step_mm = 0.6;
  double axis_x_mm = 0;
  double axis_z_mm = 15;          // the vertical axis that the scanner's arm turns about
  bool bathing_cap = true;        // no hair, a cap over the skull
  double missing_hair = 0.8;      // share of the hair, in patches, that the laser does not see; 0
  double max_angle_deg = 78;      // between surface and laser: steeper ones (below the chin) are not measured; 90
  double dropouts = 0.001;        // share of the pixels that are lost without a reason; 0
  double noise_mm = 0.1;          // standard deviation of the radius; 0
  double radius_step_mm = 0.016;  // the radius comes in multiples of it; 0
  double shading = 0.35;          // how much of the colour is the cosine towards the arm's lamp; 0: pure albedo
  double colour_noise = 1.5;      // standard deviation of the colours, in 1/255; 0
  std::int64_t seed = 1;
};

struct LaserScanResult {
  CylinderScan scan;
  SurfaceMap truth;  // in (h, phi)
};

// A scan of a head by a laser on an arm that turns about it, as the Cyberware 3030 made them: r(h, phi) and RGB. Where
// the ray from the axis meets the surface more than once, the outermost is kept. Radii are where rays and triangles
// meet, exact before noise. With a bathing cap the parts called hair are left out and the skull is coated above a line
// from the hairline to the nape; it needs the rig's landmarks68. dots: markers and moles, null = none. id: of the scan,
// for its noise; may be null. Throws where the axis or the sizes are out of reason.
LaserScanResult laser_scan(const Rig& rig, const Weights& weights, const SurfaceDots* dots, const std::string* id,
                           const LaserScanOptions& options = {});

}  // namespace face::phantom
