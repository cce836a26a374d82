// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

struct ScanTemplateOptions {
  std::int64_t row_step_px = 3;  // pixels between vertices
  std::int64_t column_step_px = 2;
  double top_share = 0.8;       // how far it reaches above the brows, of the height from chin to brows
  double bottom_share = 0.2;    // below the chin
  double half_angle_deg = 92;   // to either side: in front of the ears
  double cap_tolerance = 60;    // colour difference to the forehead, 0 to 255, at which a bathing cap begins; 0 = none
  double longest_edge_mm = 60;  // as far as a chin hangs over
};

// The reference surface of scans around an axis: a mesh over the measured skin of a reference scan, vertices at every
// row_step_px-th row and column_step_px-th column in reading order, its uvs places in the scan's picture, its colours
// the scan's. As a model whose spaces are empty: mean, mean_albedo, landmarks68 (the vertices nearest to the points
// given) and, where the reference's mouth is open, inner_lips; what lies between the lips (teeth, tongue, throat) is
// cut out along the inner lips' points, moved to where colour and radius change; vertices beside it move along their
// column to where it begins. (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and Video, 2003, section 2.2.)
// A mouth whose inner lips are less than three rows apart is closed and stays whole. Small holes are filled from their
// rims. Pixels of a bathing cap are left out: down every column as long as the colour's hue differs from the
// forehead's. landmarks: all 68 of Multi-PIE by number ("0" or "00" to "67"), pixels of the scan's picture.
MorphableModel scan_template(const CylinderScan& reference, const Landmarks& landmarks,
                             const ScanTemplateOptions& options = {});

}  // namespace face::model
