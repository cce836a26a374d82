// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/match_cylinder.h"

#include <algorithm>
#include <cmath>

#include "nodes/align/orient.h"
#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/model/cylinder_grid.h"
#include "nodes/model/head_points.h"
#include "nodes/model/scan_surface.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

constexpr double shut_mm = 6;      // edges of a shut mouth come out nearer to each other
constexpr double teeth_mm = 2;     // and what is seen between them is no farther behind them
constexpr float overhang_mm = 25;  // longer edges cross what is hidden
constexpr double hidden_mm = 1.5;  // a vertex this far behind what the scanner sees there is hidden

using Point = std::array<double, 3>;

Point point_of(const Vec3f& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

void check_shape(const MeshPoints& shape, std::size_t skin, const char* name) {
  check(shape.points_mm.size() == skin, name, " has ", shape.points_mm.size(), " vertices, the surface's skin has ",
        skin);
}

// Vertices that share an edge, for the skin. Edges from chin to neck, across what no scan shows, do not count: what one
// does tells nothing of the other.
std::vector<std::vector<std::uint32_t>> neighbours_of(const MorphableModel& surface, std::size_t skin) {
  std::vector<std::vector<std::uint32_t>> near(skin);
  for (const render::Triangle& t : render::triangulate(surface.mean).triangles) {
    if (t[0] >= skin || t[1] >= skin || t[2] >= skin) continue;
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3}) {
        const Vec3f &p = surface.mean.points_mm[t[k]], &q = surface.mean.points_mm[t[other]];
        if (std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= overhang_mm) near[t[k]].push_back(t[other]);
      }
  }
  for (auto& list : near) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return near;
}

// The flow between pixels; false where one of the pixels it is made of is not valid.
bool flow_at(const FlowField& flow, double x_px, double y_px, double& du, double& dv) {
  if (!(x_px >= 0 && y_px >= 0 && x_px <= flow.width - 1 && y_px <= flow.height - 1)) return false;
  const int x = std::min(static_cast<int>(x_px), flow.width - 2), y = std::min(static_cast<int>(y_px), flow.height - 2);
  const double fx = x_px - x, fy = y_px - y;
  du = dv = 0;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double share = (dx == 1 ? fx : 1 - fx) * (dy == 1 ? fy : 1 - fy);
      if (share == 0) continue;
      const auto i = static_cast<std::size_t>((y + dy) * flow.width + x + dx);
      if (flow.valid[i] == 0) return false;
      du += share * static_cast<double>(flow.displacement_px[i][0]);
      dv += share * static_cast<double>(flow.displacement_px[i][1]);
    }
  return true;
}

// Found vertices that move otherwise than the median of those up to two edges away.
std::vector<std::uint32_t> outliers(const std::vector<Point>& moved, const std::vector<std::uint8_t>& found,
                                    const std::vector<std::vector<std::uint32_t>>& near, double outlier_mm) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t v = 0; v < moved.size(); ++v) {
    if (found[v] == 0) continue;
    std::array<std::vector<double>, 3> about;
    for (const std::uint32_t a : near[v])
      for (const std::uint32_t b : near[a])
        if (b != v && found[b] != 0)
          for (std::size_t k = 0; k < 3; ++k) about[k].push_back(moved[b][k]);
    if (about[0].size() < 4) continue;
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) squared += std::pow(moved[v][k] - median(std::move(about[k])), 2);
    if (squared > outlier_mm * outlier_mm) result.push_back(v);
  }
  return result;
}

// Values (6 per vertex) of those that are not found: means of their neighbours, all at once.
using Values = std::array<double, 6>;
void fill(const std::vector<std::uint8_t>& found, const std::vector<std::vector<std::uint32_t>>& near,
          std::vector<Values>& values) {
  // A first guess by growing inwards from what is found, then relaxation.
  std::vector<std::uint32_t> order;
  std::vector<std::uint8_t> known = found;
  std::vector<std::uint32_t> front;
  for (std::uint32_t v = 0; v < found.size(); ++v)
    if (found[v] != 0) front.push_back(v);
  const auto mean_of = [&](std::uint32_t v) {
    Values sum{};
    double count = 0;
    for (const std::uint32_t n : near[v])
      if (known[n] != 0) {
        ++count;
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += values[n][k];
      }
    for (double& s : sum) s /= std::max(count, 1.0);
    return sum;
  };
  while (!front.empty()) {
    std::vector<std::uint32_t> reached;
    for (const std::uint32_t v : front)
      for (const std::uint32_t n : near[v])
        if (known[n] == 0) reached.push_back(n);
    std::sort(reached.begin(), reached.end());
    reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
    for (const std::uint32_t v : reached) values[v] = mean_of(v);
    for (const std::uint32_t v : reached) known[v] = 1, order.push_back(v);
    front = std::move(reached);
  }
  constexpr int sweeps = 60;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const std::uint32_t v : order) values[v] = mean_of(v);
}

// The ends of the lips in one column of the mouth, and what the scan shows between them.
struct LipGap {
  LipPair pair;
  Point upper{}, lower{}, middle{};
  enum { shut, open, unknown } state = unknown;
};

// The measured radius nearest to a place, up to a few rows above or below: a groove has pixels that no laser reaches.
double radius_near(const CylinderScan& scan, const CylinderPixel& at) {
  constexpr int reach_px = 3;
  for (int d = 0; d <= reach_px; ++d)
    for (const int sign : {-1, 1})
      if (const double radius = cylinder_radius(scan, at.x_px, at.y_px + sign * d); radius > 0) return radius;
  return 0;
}

LipGap look_between(const CylinderScan& target, LipGap gap) {
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    gap.middle[k] = 0.5 * (gap.upper[k] + gap.lower[k]);
    squared += (gap.upper[k] - gap.lower[k]) * (gap.upper[k] - gap.lower[k]);
  }
  CylinderPixel at = cylinder_pixel(target, {static_cast<float>(gap.middle[0]), static_cast<float>(gap.middle[1]),
                                             static_cast<float>(gap.middle[2])});
  const double seen = radius_near(target, at);
  if (!(seen > 0)) return gap;
  const double behind = at.radius_mm - seen;
  // Nothing between open lips is in front of them: ends that are apart and behind what is seen were not found.
  gap.state = behind > teeth_mm || (squared > shut_mm * shut_mm && behind > 0) ? LipGap::open : LipGap::shut;
  if (gap.state == LipGap::shut) {
    at.radius_mm = seen;
    gap.middle = point_of(cylinder_world(target, at));
  }
  return gap;
}

// Columns of which nothing is known are as those about them; between a shut one and an open one, open.
void settle_unknown(std::vector<LipGap>& gaps) {
  const auto nearest = [&](auto from, auto to) {
    const auto known = std::find_if(from, to, [](const LipGap& gap) { return gap.state != LipGap::unknown; });
    return known == to ? LipGap::unknown : known->state;
  };
  const std::vector<LipGap> before = gaps;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (before[i].state != LipGap::unknown) continue;
    const auto right = nearest(before.rend() - static_cast<std::ptrdiff_t>(i), before.rend());
    const auto left = nearest(before.begin() + static_cast<std::ptrdiff_t>(i), before.end());
    gaps[i].state = right == LipGap::open || left == LipGap::open   ? LipGap::open
                    : right == LipGap::shut || left == LipGap::shut ? LipGap::shut
                                                                    : LipGap::unknown;
  }
}

// Lips that the scan shows shut have no end that flow could find: the edges of the surface's mouth are brought together
// where the scan is seen between them. Returns whether there were any.
bool close_lips(const MorphableModel& surface, const MeshPoints& start, const CylinderScan& target,
                std::vector<std::uint8_t>& found, std::vector<Values>& values) {
  std::vector<LipGap> gaps;
  for (const LipPair& pair : lip_pairs(surface, mouth_loop(surface))) {
    LipGap gap{pair, point_of(start.points_mm[pair.upper]), point_of(start.points_mm[pair.lower])};
    for (std::size_t k = 0; k < 3; ++k) {
      gap.upper[k] += values[pair.upper][k];
      gap.lower[k] += values[pair.lower][k];
    }
    gaps.push_back(look_between(target, gap));
  }
  settle_unknown(gaps);
  bool any = false;
  for (const LipGap& gap : gaps) {
    if (gap.state != LipGap::shut) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      values[gap.pair.upper][k] += gap.middle[k] - gap.upper[k];
      values[gap.pair.lower][k] += gap.middle[k] - gap.lower[k];
    }
    found[gap.pair.upper] = found[gap.pair.lower] = 1;
    any = true;
  }
  return any;
}

}  // namespace

CylinderScan draw_cylinder(const MorphableModel& surface, const MeshPoints& shape, const CylinderScan& reference) {
  check_cylinder(reference, "reference");
  const std::size_t skin = skin_count(surface);
  check_shape(shape, skin, "shape");
  check(surface.mean.uvs.size() == surface.mean.points_mm.size(), "surface has ", surface.mean.uvs.size(),
        " uvs, expected one for each of its ", surface.mean.points_mm.size(), " vertices");
  const std::vector<Vec3f> points = head_points(surface, shape.points_mm);
  const std::vector<render::Triangle> triangles = render::triangulate(surface.mean).triangles;
  const CylinderView view = view_cylinder(reference, points, triangles);
  CylinderScan out = reference;
  std::fill(out.radius_mm.begin(), out.radius_mm.end(), 0.0f);
  std::fill(out.picture.pixels.begin(), out.picture.pixels.end(), std::uint8_t{0});
  for (int y = 0; y < out.picture.height; ++y)
    for (int x = 0; x < out.picture.width; ++x) {
      const std::size_t pixel = view.raster.index(x, y);
      const std::int32_t found = view.raster.triangles[pixel];
      if (found < 0) continue;
      const render::Triangle& t = triangles[static_cast<std::size_t>(found)];
      const Vec3f b = render::barycentrics_at(view.screen, t, static_cast<float>(x), static_cast<float>(y));
      float u = 0, v = 0;
      Vec3f colour{};
      for (std::size_t i = 0; i < 3; ++i) {
        u += b[i] * surface.mean.uvs[t[i]][0];
        v += b[i] * surface.mean.uvs[t[i]][1];
        for (std::size_t c = 0; c < 3; ++c) colour[c] += b[i] * 255 * surface.mean.colors_srgb[t[i]][c];
      }
      if (t[0] < skin && t[1] < skin && t[2] < skin) {
        const std::array<double, 3> seen = cylinder_colour(reference, static_cast<double>(u) * out.picture.width - 0.5,
                                                           static_cast<double>(1 - v) * out.picture.height - 0.5);
        for (std::size_t c = 0; c < 3; ++c) colour[c] = static_cast<float>(seen[c]);
      }
      for (std::size_t c = 0; c < 3; ++c)
        out.picture.pixels[3 * pixel + c] = static_cast<std::uint8_t>(std::clamp(colour[c], 0.0f, 255.0f) + 0.5f);
      out.radius_mm[pixel] = 1000 * view.raster.inverse_depth_per_mm[pixel];
    }
  return out;
}

MatchCylinderResult match_cylinder(const MorphableModel& surface, const MeshPoints& start, const CylinderScan& drawn,
                                   const CylinderScan& target, const FlowField& flow,
                                   const MatchCylinderOptions& options) {
  check_cylinder(drawn, "drawn");
  check_cylinder(target, "target");
  const std::size_t skin = skin_count(surface);
  check_shape(start, skin, "start");
  check(flow.width == drawn.picture.width && flow.height == drawn.picture.height, "flow is ", flow.width, " x ",
        flow.height, ", drawn is ", drawn.picture.width, " x ", drawn.picture.height);
  const std::size_t pixels = drawn.radius_mm.size();
  check(flow.displacement_px.size() == pixels && flow.valid.size() == pixels, "flow has ", flow.displacement_px.size(),
        " displacements and ", flow.valid.size(), " marks, expected ", pixels, " of each");
  check(flow.width >= 2 && flow.height >= 2, "flow is ", flow.width, " x ", flow.height, ", expected at least 2 x 2");
  const auto neighbours = neighbours_of(surface, skin);
  std::vector<Point> moved(skin, Point{});
  std::vector<Values> values(skin, Values{});
  std::vector<std::uint8_t> found(skin, 0);
  for (std::size_t v = 0; v < skin; ++v) {
    const CylinderPixel from = cylinder_pixel(drawn, start.points_mm[v]);
    double du = 0, dv = 0;
    // At the rim of what is drawn there is nothing to interpolate with: the nearest pixel will do.
    double shown = cylinder_radius(drawn, from.x_px, from.y_px);
    double x = from.x_px, y = from.y_px;
    if (!(shown > 0)) shown = cylinder_radius(drawn, x = std::round(x), y = std::round(y));
    if (!(shown > 0) || shown - from.radius_mm > hidden_mm) continue;
    if (!flow_at(flow, x, y, du, dv) && !flow_at(flow, std::round(x), std::round(y), du, dv)) continue;
    CylinderPixel to{from.x_px + du, from.y_px + dv, 0};
    to.radius_mm = cylinder_radius(target, to.x_px, to.y_px);
    if (!(to.radius_mm > 0)) continue;
    const Point there = point_of(cylinder_world(target, to)), here = point_of(start.points_mm[v]);
    const std::array<double, 3> colour = cylinder_colour(target, to.x_px, to.y_px);
    for (std::size_t k = 0; k < 3; ++k) {
      moved[v][k] = values[v][k] = there[k] - here[k];
      values[v][3 + k] = colour[k];
    }
    found[v] = 1;
  }
  for (const std::uint32_t v : outliers(moved, found, neighbours, options.outlier_mm)) found[v] = 0;
  MatchCylinderResult result;
  result.sampled = static_cast<double>(std::count(found.begin(), found.end(), 1)) / static_cast<double>(skin);
  fill(found, neighbours, values);
  if (close_lips(surface, start, target, found, values)) fill(found, neighbours, values);
  result.shape.points_mm.resize(skin);
  result.texture = {static_cast<int>(skin), 1, 3, std::vector<std::uint8_t>(3 * skin)};
  for (std::size_t v = 0; v < skin; ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      result.shape.points_mm[v][k] = static_cast<float>(static_cast<double>(start.points_mm[v][k]) + values[v][k]);
      result.texture.pixels[3 * v + k] = static_cast<std::uint8_t>(std::clamp(values[v][3 + k], 0.0, 255.0) + 0.5);
    }
  return result;
}

OrientShapeResult orient_shape(const MeshPoints& shape, const MorphableModel& surface,
                               const OrientShapeOptions& options) {
  const std::size_t skin = skin_count(surface);
  check_shape(shape, skin, "shape");
  check(surface.landmarks68.size() == 68, "surface has ", surface.landmarks68.size(), " landmarks, expected 68");
  check(options.scale_mm > 0, "scale_mm is ", options.scale_mm, ", expected more than 0");
  const float low = surface.mean.points_mm[surface.landmarks68[30]][1];
  std::vector<Point> from, to;
  for (std::size_t v = 0; v < skin; ++v) {
    if (surface.mean.points_mm[v][1] <= low) continue;
    from.push_back(point_of(shape.points_mm[v]));
    to.push_back(point_of(surface.mean.points_mm[v]));
  }
  std::vector<double> weights(from.size(), 1.0);
  align::AbsoluteOrientation found;
  const auto turned = [&](const Point& p) {
    Point out{};
    for (std::size_t r = 0; r < 3; ++r) {
      out[r] = found.to_from.translation_mm[r];
      for (std::size_t c = 0; c < 3; ++c) out[r] += found.to_from.rotation[3 * r + c] * p[c];
    }
    return out;
  };
  constexpr int rounds = 8;
  for (int round = 0; round < rounds; ++round) {
    found = align::absolute_orientation(from, to, weights);
    if (!found.solved) break;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Point p = turned(from[i]);
      double squared = 0;
      for (std::size_t k = 0; k < 3; ++k) squared += (p[k] - to[i][k]) * (p[k] - to[i][k]);
      const double e = 1 + squared / (options.scale_mm * options.scale_mm);
      weights[i] = 1 / (e * e);
    }
  }
  OrientShapeResult result;
  result.surface_from_scan = found.to_from;
  result.rms_mm = found.rms_mm;
  for (const Vec3f& p : shape.points_mm) {
    const Point q = turned(point_of(p));
    result.shape.points_mm.push_back({static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2])});
  }
  return result;
}

}  // namespace face::model
