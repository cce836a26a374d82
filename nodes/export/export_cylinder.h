// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/cylinder_scan.h"

namespace face::exports {

struct ExportCylinderOptions {
  double radius_unit_mm = 0.005;
};

struct ExportCylinderResult {
  engine::File header;  // JSON
  engine::File radius;  // grey PNG of 16 bits, in radius_unit_mm; 0 = nothing measured
  engine::File colour;  // PNG
};

// Writes a scan around an axis as decode.cylinder_scan reads it. A radius is rounded to the nearest unit and never to
// 0; throws where one is more than 65535 units.
ExportCylinderResult export_cylinder(const CylinderScan& scan, const ExportCylinderOptions& options = {});

}  // namespace face::exports
