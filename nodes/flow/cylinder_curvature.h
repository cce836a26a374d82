// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/cylinder_scan.h"

namespace face::flow {

struct CylinderCurvature {
  std::vector<float> times_scale;   // rows x columns: mean curvature (1/mm) times the scale; 1 on a ball of that radius
  std::vector<std::uint8_t> known;  // rows x columns: 1 where enough is measured about the pixel, else 0
};

// Mean curvature of a scan's surface at every pixel, positive where it bulges: -H of do Carmo, Differential Geometry of
// Curves and Surfaces, 1976, section 3.3 (normal to the outside), for the surface r(h, phi), its radius first smoothed
// by a Gaussian of scale_mm (normalised convolution: Knutsson and Westin, CVPR 1993). Tips of noses and chins, edges of
// jaws and sockets stand out in it wherever they lie and however large the head is. Large values are shortened:
// c / sqrt(1 + c^2 / 4).
CylinderCurvature cylinder_curvature(const CylinderScan& scan, double scale_mm);

}  // namespace face::flow
