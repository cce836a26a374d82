// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/stretch_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/model/scan_surface.h"

namespace face::model {

ShapeModel stretch_space(const MorphableModel& surface, const StretchSpaceOptions& options) {
  const std::size_t skin = skin_count(surface);
  check(skin > 0, "surface has no skin");
  const std::vector<Vec3f>& points = surface.mean.points_mm;
  std::array<double, 3> low{}, high{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [least, most] = std::minmax_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(skin),
                                                   [&](const Vec3f& a, const Vec3f& b) { return a[k] < b[k]; });
    low[k] = static_cast<double>((*least)[k]);
    high[k] = static_cast<double>((*most)[k]);
  }
  struct Monomial {
    int x, y, z;
    double sigma_mm;
  };
  std::vector<Monomial> monomials = {{0, 0, 0, options.place_mm}, {0, 0, 1, options.stretch_mm}};
  for (int order = 1; order <= 3; ++order)
    for (int x = 0; x <= order; ++x)
      monomials.push_back({x, order - x, 0,
                           order == 1   ? options.stretch_mm
                           : order == 2 ? options.bend_mm
                                        : 0.5 * options.bend_mm});
  std::stable_sort(monomials.begin(), monomials.end(),
                   [](const Monomial& a, const Monomial& b) { return a.sigma_mm > b.sigma_mm; });
  ShapeModel space;
  space.vertices = skin;
  for (std::size_t v = 0; v < skin; ++v)
    for (const float value : points[v]) space.mean_mm.push_back(static_cast<double>(value));
  for (const Monomial& m : monomials)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      space.sigmas_mm.push_back(m.sigma_mm);
      for (std::size_t v = 0; v < skin; ++v) {
        std::array<double, 3> place{};
        for (std::size_t k = 0; k < 3; ++k)
          place[k] = 2 * (static_cast<double>(points[v][k]) - low[k]) / std::max(high[k] - low[k], 1e-6) - 1;
        const double value = std::pow(place[0], m.x) * std::pow(place[1], m.y) * std::pow(place[2], m.z);
        for (std::size_t k = 0; k < 3; ++k) space.modes.push_back(k == axis ? value : 0);
      }
    }
  // Not orthogonal: what projects a shape is the pseudo-inverse, which nobody asks for here.
  space.projections.assign(space.modes.size(), 0.0);
  return space;
}

}  // namespace face::model
