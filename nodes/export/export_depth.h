// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/camera.h"
#include "nodes/types/depth_scan.h"

namespace face::exports {

struct ExportDepthOptions {
  double depth_unit_mm = 0.05;
};

struct ExportDepthResult {
  engine::File depth;    // 16-bit grey PNG, 0 = nothing measured
  engine::File picture;  // 8-bit PNG
};

// Writes a scan as depth and picture, as decode.depth_take reads them. Depth is rounded to whole units. Throws where a
// depth has more than 65535 of them.
ExportDepthResult export_depth(const DepthScan& scan, const ExportDepthOptions& options = {});

struct ExportScanCameraOptions {
  std::int64_t width_px = 640;
  std::int64_t height_px = 480;
  double depth_unit_mm = 0.05;
  double rate_hz = 40;
};

// Writes the camera.json of a recorded stream: intrinsics, pose, unit of depth and rate.
engine::File export_scan_camera(const Camera& camera, const ExportScanCameraOptions& options = {});

}  // namespace face::exports
