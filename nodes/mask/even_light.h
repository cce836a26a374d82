// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/depth_scan.h"

namespace face::mask {

struct EvenLightOptions {
  double wild = 0.15;
  double least_light = 0.25;
};

// A scan's picture as even light would show it: the light is found from the scan itself, as that which skin of one
// colour needs, by the second-order spherical harmonics of the surface's normal in the camera's frame (Basri and
// Jacobs, Lambertian Reflectance and Linear Subspaces, PAMI 2003), and divided out, so that the middle of what is seen
// keeps its brightness. Skin of one colour: linear light that departs by `wild` of it (lips, brows, lashes, dots,
// shadows that are cast) counts half. Light below least_light of the middle is taken as that. Depth stays as it is;
// what has no depth, or no neighbours with depth, keeps its picture, and so has a scan with fewer than a hundred
// normals.
DepthScan even_light(const DepthScan& scan, const EvenLightOptions& options = {});

}  // namespace face::mask
