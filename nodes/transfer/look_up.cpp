// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/look_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/lip_sides.h"

namespace face::transfer {
namespace {

// A vertex unrolled about the axis: along the turn (at 80 mm from the axis, so that all three are lengths), height,
// radius.
using Unrolled = std::array<double, 3>;
constexpr std::uint8_t on_skin = 2;
constexpr double brow_mm = 3;  // brows lie less far before the skin, and are what is seen
constexpr double unroll_mm = 80, cell_mm = 4, farthest_mm = 10000;
// Less than the head's own margin: near a corner a vertex that is not quite sure still keeps off what surely is the
// other lip.
constexpr float own_margin_mm = 1.5f;

Unrolled unrolled(const Axis& axis, const Vec3f& point_mm) {
  const CylinderPlace place = cylinder_place(axis, point_mm);
  return {place.phi_rad * unroll_mm, place.h_mm, place.radius_mm};
}

std::vector<Unrolled> unrolled(const Axis& axis, const MeshPoints& points, const char* name) {
  std::vector<Unrolled> all;
  for (const Vec3f& p : points.points_mm) {
    all.push_back(unrolled(axis, p));
    check(std::hypot(all.back()[0], all.back()[1], all.back()[2]) < farthest_mm, name, " has a point ", all.size() - 1,
          " at (", p[0], ", ", p[1], ", ", p[2], ") mm, expected one less than ", farthest_mm,
          " mm from the axis's origin");
  }
  return all;
}

double cross2(const Unrolled& a, const Unrolled& b, const Unrolled& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

using Weights3 = std::array<double, 3>;

// The point of a segment that is nearest in (turn, height).
double on_segment(const Unrolled& a, const Unrolled& b, const Unrolled& p) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
  return length > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length, 0.0, 1.0) : 0;
}

// Weights of the point of a triangle nearest to p in (turn, height).
Weights3 nearest(const std::array<const Unrolled*, 3>& t, const Unrolled& p) {
  const double area = cross2(*t[0], *t[1], *t[2]);
  if (area != 0) {
    const Weights3 w = {cross2(*t[1], *t[2], p) / area, cross2(*t[2], *t[0], p) / area, cross2(*t[0], *t[1], p) / area};
    if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) return w;
  }
  Weights3 best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t n = (k + 1) % 3;
    const double s = on_segment(*t[k], *t[n], p);
    const double x = (*t[k])[0] + s * ((*t[n])[0] - (*t[k])[0]) - p[0],
                 y = (*t[k])[1] + s * ((*t[n])[1] - (*t[k])[1]) - p[1];
    if (x * x + y * y >= least) continue;
    least = x * x + y * y;
    best = {};
    best[k] = 1 - s;
    best[n] = s;
  }
  return best;
}

// Triangles by the cells of the unrolled picture that they touch.
class Cells {
 public:
  Cells(const std::vector<Unrolled>& points, const std::vector<render::Triangle>& triangles) {
    for (const Unrolled& p : points) {
      low_h_ = std::min(low_h_, p[1]);
      high_h_ = std::max(high_h_, p[1]);
    }
    columns_ = 1 + static_cast<int>(2 * M_PI * unroll_mm / cell_mm);
    rows_ = 1 + static_cast<int>((high_h_ - low_h_) / cell_mm);
    cells_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Unrolled &a = points[triangles[t][0]], &b = points[triangles[t][1]], &c = points[triangles[t][2]];
      const auto [left, right] = std::minmax({a[0], b[0], c[0]});
      const auto [low, high] = std::minmax({a[1], b[1], c[1]});
      if (right - left > M_PI * unroll_mm) continue;  // across the back
      for (int y = row(low); y <= row(high); ++y)
        for (int x = column(left); x <= column(right); ++x)
          cells_[static_cast<std::size_t>(y * columns_ + x)].push_back(t);
    }
  }

  template <class Visit>
  void around(const Unrolled& p, double reach_mm, Visit visit) const {
    if (p[1] < low_h_ - reach_mm || p[1] > high_h_ + reach_mm) return;
    for (int y = row(p[1] - reach_mm); y <= row(p[1] + reach_mm); ++y)
      for (int x = column(p[0] - reach_mm); x <= column(p[0] + reach_mm); ++x)
        for (const std::uint32_t t : cells_[static_cast<std::size_t>(y * columns_ + x)]) visit(t);
  }

 private:
  int row(double h) const { return std::clamp(static_cast<int>((h - low_h_) / cell_mm), 0, rows_ - 1); }
  int column(double x) const { return std::clamp(static_cast<int>((x + M_PI * unroll_mm) / cell_mm), 0, columns_ - 1); }
  double low_h_ = 1e9, high_h_ = -1e9;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace

SurfaceMap look_up(const MorphableModel& model, const MeshPoints& fitted, const Mesh& mesh, const MeshPoints& shape,
                   const Axis& axis, const LookUpOptions& options) {
  check(fitted.points_mm.size() == model.mean.points_mm.size(), "fitted has ", fitted.points_mm.size(),
        " points, the model ", model.mean.points_mm.size());
  check(shape.points_mm.size() == mesh.points_mm.size(), "shape has ", shape.points_mm.size(), " points, the mesh ",
        mesh.points_mm.size());
  const auto reach = static_cast<float>(options.lip_reach_mm);
  const std::vector<LipSide> model_sides = head_sides(model.mean, model.inner_lips, model.landmarks68, reach);
  std::vector<LipSide> sides(mesh.points_mm.size(), LipSide::none);
  const MouthOpening mouth = find_mouth_opening(mesh);
  if (mouth.found()) sides = sides_of(mesh, mesh.points_mm, mouth.upper, mouth.lower, reach, own_margin_mm);

  const std::vector<Unrolled> head = unrolled(axis, fitted, "fitted"), own = unrolled(axis, shape, "shape");
  const render::Triangulation all = render::triangulate(model.mean, false);
  std::vector<std::uint8_t> outside = skin_polygons(model.mean, model.landmarks68);
  for (const Part& part : model.mean.parts)
    if (part.name.starts_with("sclera") || part.name.starts_with("iris") || part.name == "brows")
      std::fill_n(outside.begin() + part.first_polygon, part.polygon_count,
                  part.name == "brows" ? on_skin : std::uint8_t{1});
  // Triangles that face outwards: counter-clockwise in the unrolled picture.
  std::vector<render::Triangle> triangles;
  std::vector<std::int32_t> numbers;
  std::vector<std::uint8_t> hides;  // the skin below it
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    const render::Triangle& c = all.triangles[t];
    if (!outside[all.polygons[t]] || !(cross2(head[c[0]], head[c[1]], head[c[2]]) > 0)) continue;
    triangles.push_back(c);
    numbers.push_back(static_cast<std::int32_t>(t));
    hides.push_back(outside[all.polygons[t]] == on_skin);
  }
  const Cells cells(head, triangles);
  const auto allowed = [&](const render::Triangle& t, LipSide side) {
    if (side == LipSide::none) return true;
    for (const std::uint32_t v : t)
      if (model_sides[v] != LipSide::none && model_sides[v] != side) return false;
    return true;
  };

  const std::size_t count = own.size();
  SurfaceMap places{static_cast<int>(count), 1, std::vector<std::int32_t>(count, -1),
                    std::vector<Vec2f>(count, Vec2f{0, 0})};
  for (std::size_t i = 0; i < count; ++i) {
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](std::uint32_t t) {
      const render::Triangle& corners = triangles[t];
      if (!allowed(corners, sides[i])) return;
      const Weights3 w = nearest({&head[corners[0]], &head[corners[1]], &head[corners[2]]}, own[i]);
      Unrolled at{};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t a = 0; a < 3; ++a) at[a] += w[k] * head[corners[k]][a];
      const double beside = std::hypot(at[0] - own[i][0], at[1] - own[i][1]), before = std::fabs(at[2] - own[i][2]);
      if (beside > options.reach_mm || before > options.depth_mm) return;
      // What covers the place goes before what lies beside it.
      const double cost = before + 10 * beside - (hides[t] ? brow_mm : 0);
      if (cost >= least) return;
      least = cost;
      places.triangle[i] = numbers[t];
      places.weights[i] = {static_cast<float>(w[0]), static_cast<float>(w[1])};
    };
    cells.around(own[i], options.reach_mm, look);
  }
  return places;
}

}  // namespace face::transfer
