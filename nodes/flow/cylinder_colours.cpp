// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/cylinder_colours.h"

#include <cmath>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/flow/cylinder_curvature.h"

namespace face::flow {

FeatureMap cylinder_colours(const CylinderScan& scan, const CylinderColoursOptions& options) {
  const Image& picture = scan.picture;
  const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  check(scan.radius_mm.size() == count, "scan has ", scan.radius_mm.size(), " radii, its picture is ", picture.width,
        " x ", picture.height, " pixels");
  check(picture.channels == 3 && picture.pixels.size() == 3 * count, "scan has a picture of ", picture.channels,
        " channels and ", picture.pixels.size(), " bytes, expected 3 channels and ", 3 * count, " bytes");
  FeatureMap map{picture.width, picture.height, {"radius", "red", "green", "blue"}, scan.radius_mm, {}};
  map.values.resize(4 * count);
  map.valid.resize(count);
  const double reach = options.half_angle_deg * std::numbers::pi / 180 / static_cast<double>(scan.phi_step_rad);
  std::size_t i = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, ++i) {
      const bool near = std::abs(x - 0.5 * (picture.width - 1)) <= reach;
      map.valid[i] = near && scan.radius_mm[i] > 0 ? 1 : 0;
      for (std::size_t c = 0; c < 3; ++c)
        map.values[(c + 1) * count + i] = static_cast<float>(picture.pixels[3 * i + c]);
    }
  if (options.curvature_scale_mm > 0) {
    const CylinderCurvature curvature = cylinder_curvature(scan, options.curvature_scale_mm);
    map.names.push_back("curvature");
    map.values.insert(map.values.end(), curvature.times_scale.begin(), curvature.times_scale.end());
    for (std::size_t p = 0; p < count; ++p) map.valid[p] = map.valid[p] != 0 && curvature.known[p] != 0 ? 1 : 0;
  }
  return map;
}

}  // namespace face::flow
