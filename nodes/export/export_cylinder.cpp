// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_cylinder.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/export/png16.h"
#include "nodes/render/encode_png.h"

namespace face::exports {

ExportCylinderResult export_cylinder(const CylinderScan& scan, const ExportCylinderOptions& options) {
  check(options.radius_unit_mm > 0, "radius_unit_mm is ", options.radius_unit_mm, ", expected more than 0");
  const std::size_t count =
      static_cast<std::size_t>(scan.picture.width) * static_cast<std::size_t>(scan.picture.height);
  check(scan.radius_mm.size() == count, "scan has ", scan.radius_mm.size(), " radii, its picture is ",
        scan.picture.width, " x ", scan.picture.height, " pixels");
  std::vector<std::uint16_t> units;
  units.reserve(count);
  for (const float radius : scan.radius_mm) {
    const double value = std::round(static_cast<double>(radius) / options.radius_unit_mm);
    check(value <= 65535, "a radius is ", radius, " mm, expected at most 65535 units of ", options.radius_unit_mm,
          " mm");
    units.push_back(radius > 0 ? static_cast<std::uint16_t>(std::max(1.0, value)) : std::uint16_t{0});
  }
  nlohmann::ordered_json header;
  header["axis_origin_mm"] = scan.axis.origin_mm;
  header["axis_direction"] = scan.axis.direction;
  header["top_mm"] = scan.top_mm;
  header["step_mm"] = scan.step_mm;
  header["phi_step_deg"] = static_cast<double>(scan.phi_step_rad) * 180 / std::numbers::pi;
  header["radius_unit_mm"] = options.radius_unit_mm;
  return {engine::File::from_bytes(header.dump(2) + "\n", ".json"),
          engine::File::from_bytes(encode_png16(units, scan.picture.width, scan.picture.height), ".png"),
          engine::File::from_bytes(render::encode_png(scan.picture), ".png")};
}

}  // namespace face::exports
