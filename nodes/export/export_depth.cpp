// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_depth.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"
#include "nodes/export/png16.h"
#include "nodes/render/encode_png.h"

namespace face::exports {

ExportDepthResult export_depth(const DepthScan& scan, const ExportDepthOptions& options) {
  check_scan(scan, "scan");
  std::vector<std::uint16_t> units;
  for (std::size_t i = 0; i < scan.depth_mm.size(); ++i) {
    const double depth = static_cast<double>(scan.depth_mm[i]), count = std::round(depth / options.depth_unit_mm);
    check(std::isfinite(count) && count < 65536, "pixel ", i, " has a depth of ", depth, " mm, which is ", count,
          " units of ", options.depth_unit_mm, " mm, expected at most 65535");
    units.push_back(static_cast<std::uint16_t>(count > 0 ? count : 0));
  }
  return {engine::File::from_bytes(encode_png16(units, scan.picture.width, scan.picture.height), ".png"),
          engine::File::from_bytes(render::encode_png(scan.picture), ".png")};
}

engine::File export_scan_camera(const Camera& camera, const ExportScanCameraOptions& options) {
  nlohmann::ordered_json json;
  json["fx"] = camera.focal_px;
  json["fy"] = camera.focal_px;
  json["cx"] = camera.centre_x_px;
  json["cy"] = camera.centre_y_px;
  json["width"] = options.width_px;
  json["height"] = options.height_px;
  json["depth_unit_mm"] = options.depth_unit_mm;
  json["rate_hz"] = options.rate_hz;
  json["cam_from_world"] = camera.cam_from_world;
  json["position_mm"] = camera.position_mm;
  return engine::File::from_bytes(json.dump(2) + "\n", ".json");
}

}  // namespace face::exports
