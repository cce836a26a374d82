// SPDX-License-Identifier: Apache-2.0
// What a scan around an axis shows between its pixels: surface, colours and curvature, with how they change.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "nodes/types/cylinder_scan.h"

namespace face::model {

// The surface that a ray from the axis meets.
struct ScanPlace {
  double x_px = 0, y_px = 0;
  std::array<double, 3> point_mm{}, normal{};  // normal to the outside, of length 1
};

// Value of a map and its change per mm along the surface.
struct ScanValue {
  double value = 0;
  std::array<double, 3> gradient{};
};

class ScanMaps {
 public:
  static constexpr std::size_t colours = 3;
  enum Detail : std::size_t { coarse, fine };

  // Radii smoothed by 1.2 mm for normals, colours by 5 mm (coarse) and 1.5, curvature as cylinder_curvature says.
  // Colours are the logarithm of the brightness and the shares of red and blue, in steps about as large as 8 bits'.
  ScanMaps(const CylinderScan& scan, double curvature_scale_mm);
  ~ScanMaps();

  // Under a point; nothing where nothing is measured there.
  std::optional<ScanPlace> find(const std::array<double, 3>& point_mm) const;
  ScanValue colour(const ScanPlace& place, std::size_t channel, Detail detail) const;
  ScanValue curvature(const ScanPlace& place) const;

 private:
  class Maps;
  std::unique_ptr<const Maps> maps_;
};

}  // namespace face::model
