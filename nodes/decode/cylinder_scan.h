// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/cylinder_scan.h"

namespace face::decode {

// Reads a laser scan around an axis from a pair of pictures and a header.
//   header   {"axis_origin_mm": [0, 0, 15], "axis_direction": [0, 1, 0], "top_mm": 160, "step_mm": 0.6,
//             "radius_unit_mm": 0.01, "phi_step_deg": 0.703125}; the last one may be left out, the columns are then one
//            full turn. Rows run down, columns as CylinderScan says: the middle looks along +z, phi grows towards +x.
//   radius   grey PNG of 8 or 16 bits in radius_unit_mm, or EXR; 0 or not finite = nothing measured
//   colour   a picture of the same size
// Throws where a file is not that, naming file and place.
CylinderScan cylinder_scan(const engine::File& header, const engine::File& radius, const engine::File& colour);

}  // namespace face::decode
