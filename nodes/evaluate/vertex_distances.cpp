// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/vertex_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "nodes/evaluate/draw_heat_map.h"
#include "nodes/evaluate/draw_text.h"
#include "nodes/evaluate/statistics.h"
#include "nodes/render/render_head.h"

namespace face::evaluate {
namespace {

constexpr double far_mm = std::numeric_limits<double>::infinity();
constexpr double moved_mm = 0.001;  // ten times what a float tells apart at the size of a head
constexpr int picture_px = 480;

bool finite(const Vec3f& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

double distance(const Vec3f& a, const Vec3f& b) {
  return std::hypot(double(a[0]) - b[0], double(a[1]) - b[1], double(a[2]) - b[2]);
}

// The nearest of points that are sorted by x: outwards from where p would stand.
double nearest(const Vec3f& p, const std::vector<Vec3f>& by_x) {
  const auto start =
      std::lower_bound(by_x.begin(), by_x.end(), p, [](const Vec3f& a, const Vec3f& b) { return a[0] < b[0]; });
  double best = far_mm;
  for (auto at = start; at != by_x.end() && double((*at)[0]) - p[0] < best; ++at)
    best = std::min(best, distance(p, *at));
  for (auto at = start; at != by_x.begin() && double(p[0]) - (*(at - 1))[0] < best; --at)
    best = std::min(best, distance(p, *(at - 1)));
  return best;
}

// 1, 2 or 5 times a power of ten, not below the value.
double rounded_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= value) return factor * power;
  return 10 * power;
}

bool drawable(const Rig& rig) {
  const std::vector<Vec3f>& points = rig.neutral.points_mm;
  return rig.neutral.polygon_count() > 0 && std::all_of(points.begin(), points.end(), finite);
}

}  // namespace

VertexDistances vertex_distances(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  VertexDistances result;
  result.matched = a.size() == b.size();
  if (b.empty()) return result;
  std::vector<Vec3f> by_x;
  if (!result.matched) {
    std::copy_if(b.begin(), b.end(), std::back_inserter(by_x), finite);
    std::stable_sort(by_x.begin(), by_x.end(), [](const Vec3f& p, const Vec3f& q) { return p[0] < q[0]; });
  }
  for (std::size_t v = 0; v < a.size(); ++v) {
    if (!finite(a[v]) || (result.matched && !finite(b[v])))
      result.mm.push_back(far_mm);
    else
      result.mm.push_back(result.matched ? distance(a[v], b[v]) : nearest(a[v], by_x));
  }
  return result;
}

std::vector<double> distance_values(const VertexDistances& distances) {
  const std::vector<double>& mm = distances.mm;
  return {mean_of(mm),
          rms_of(mm),
          quantile(mm, 0.95),
          largest_of(mm),
          100 - percent_within(mm, moved_mm),
          static_cast<double>(mm.size()),
          distances.matched ? 1.0 : 0.0};
}

Image draw_distances(const Rig& a, const Rig& b, const std::vector<double>& distance_mm) {
  if (!drawable(a) || distance_mm.size() != a.neutral.points_mm.size()) return {};
  std::vector<double> shown = distance_mm, known;
  for (const double mm : distance_mm)
    if (std::isfinite(mm)) known.push_back(mm);
  const double full_mm = rounded_up(std::max(1e-3, known.empty() ? 0 : quantile(known, 0.99)));
  for (double& mm : shown) mm = std::min(mm, 1e6);
  const Image map = draw_heat_map(a, shown, full_mm);
  Canvas canvas(2 * picture_px + map.width, picture_px);
  render::RenderHeadOptions options;
  options.width_px = options.height_px = picture_px;
  options.framing = render::Framing::face;
  canvas.paste(render::render_head(a, {}, options), 0, 0);
  if (drawable(b)) canvas.paste(render::render_head(b, {}, options), picture_px, 0);
  canvas.paste(map, 2 * picture_px, 0);
  canvas.text("A", {10, 22}, 11, ink);
  canvas.text("B", {picture_px + 10.0, 22}, 11, ink);
  canvas.text("distance", {2 * picture_px + 10.0, 22}, 11, ink);
  return canvas.image();
}

}  // namespace face::evaluate
