// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/scan_channels.h"

#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"
#include "nodes/flow/image_channels.h"

namespace face::flow {

FeatureMap scan_channels(const DepthScan& scan, const Axis* axis) {
  check_scan(scan, "scan");
  const Axis line = axis ? *axis : Axis{};
  const ScanRays rays(scan.camera);
  FeatureMap map{scan.picture.width, scan.picture.height, {"radius", "grey"}, {}, {}};
  const std::size_t count = scan.depth_mm.size();
  map.values.assign(2 * count, 0);
  map.valid.assign(count, 0);
  std::size_t i = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x, ++i) {
      if (!(scan.depth_mm[i] > 0)) continue;
      map.valid[i] = 1;
      map.values[i] = static_cast<float>(radius_about(line, rays.point(x, y, scan.depth_mm[i])));
    }
  write_grey(scan.picture, map.values.data() + count);
  return map;
}

FeatureMap cylinder_channels(const CylinderScan& scan) {
  const Image& picture = scan.picture;
  const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  check(scan.radius_mm.size() == count, "scan has ", scan.radius_mm.size(), " radii, its picture is ", picture.width,
        " x ", picture.height, " pixels");
  FeatureMap map{picture.width, picture.height, {"radius", "grey"}, scan.radius_mm, {}};
  for (const float radius : scan.radius_mm) map.valid.push_back(radius > 0 ? 1 : 0);
  map.values.resize(2 * count);
  write_grey(picture, map.values.data() + count);
  return map;
}

}  // namespace face::flow
