// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/remove_mouth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"
#include "nodes/base/quantile.h"
#include "nodes/base/scan_points.h"

namespace face::mask {
namespace {

struct Rectangle {
  int left, top, width, height;
};

Rectangle rectangle_of(const DepthScan& scan, const Landmarks* moved, const Landmarks* before,
                       const RemoveMouthOptions& options) {
  const int width = scan.picture.width, height = scan.picture.height;
  std::vector<double> dx, dy;
  if (moved && before) {
    std::map<std::string, const Landmark*> start;
    for (const Landmark& point : before->points)
      if (point.valid) start[point.name] = &point;
    for (const Landmark& point : moved->points) {
      const auto found = start.find(point.name);
      if (!point.valid || found == start.end()) continue;
      dx.push_back(point.x_px - found->second->x_px);
      dy.push_back(point.y_px - found->second->y_px);
    }
  }
  const int w = std::clamp(static_cast<int>(std::lround(options.width * width)), 3, width);
  const int h = std::clamp(static_cast<int>(std::lround(options.height * height)), 3, height);
  const int left = static_cast<int>(std::lround(options.centre_x * width + median(dx) - 0.5 * w));
  const int top = static_cast<int>(std::lround(options.centre_y * height + median(dy) - 0.5 * h));
  return {std::clamp(left, 0, width - w), std::clamp(top, 0, height - h), w, h};
}

// How far every pixel of the rectangle lies behind a band stretched down its column, mm; -1 where nothing is measured.
std::vector<float> depth_below_band(const DepthScan& scan, const Rectangle& box) {
  std::vector<float> below(static_cast<std::size_t>(box.width * box.height), -1);
  const int stride = scan.picture.width;
  struct Point {
    int y;
    double depth;
  };
  for (int x = 0; x < box.width; ++x) {
    const auto depth_of = [&](int y) {
      return static_cast<double>(scan.depth_mm[static_cast<std::size_t>((box.top + y) * stride + box.left + x)]);
    };
    // Lower convex hull of depth (the camera's side of the surface), left to right in y (Andrew 1979). A point that
    // stands out of its column by itself is noise: the median of three.
    std::vector<Point> measured, hull;
    for (int y = 0; y < box.height; ++y)
      if (depth_of(y) > 0) measured.push_back({y, depth_of(y)});
    for (std::size_t i = 0; i < measured.size(); ++i) {
      Point p = measured[i];
      if (i > 0 && i + 1 < measured.size()) {
        const double a = measured[i - 1].depth, b = measured[i + 1].depth;
        p.depth = std::clamp(p.depth, std::min(a, b), std::max(a, b));
      }
      while (hull.size() >= 2) {
        const Point &a = hull[hull.size() - 2], &b = hull.back();
        if ((b.depth - a.depth) * (p.y - a.y) < (p.depth - a.depth) * (b.y - a.y)) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    std::size_t edge = 0;
    for (const Point& p : measured) {
      while (edge + 2 < hull.size() && hull[edge + 1].y < p.y) ++edge;
      double band = hull[edge].depth;
      if (hull.size() > 1) {
        const Point &a = hull[edge], &b = hull[edge + 1];
        band = a.depth + (b.depth - a.depth) * (p.y - a.y) / (b.y - a.y);
      }
      below[static_cast<std::size_t>(p.y * box.width + x)] = static_cast<float>(std::max(p.depth - band, 0.0));
    }
  }
  return below;
}

// Marks of the rectangle: 1 = inside the mouth. Seeds are what lies deep, grown over what is not measured beside it;
// specks, and what lies off the middle, go.
std::vector<std::uint8_t> inside_of(const std::vector<float>& below, const Rectangle& box, double threshold_mm) {
  const int w = box.width, h = box.height;
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * w + x); };
  std::vector<std::uint8_t> inside(below.size(), 0), seen(below.size(), 0);
  std::vector<std::pair<int, int>> stack, component;
  for (int sy = 0; sy < h; ++sy)
    for (int sx = 0; sx < w; ++sx) {
      if (seen[at(sx, sy)] || !(static_cast<double>(below[at(sx, sy)]) > threshold_mm)) continue;
      int deep = 0;
      double sum_x = 0, sum_y = 0;
      bool touches_side = false;
      component.clear();
      stack = {{sx, sy}};
      seen[at(sx, sy)] = 1;
      while (!stack.empty()) {
        const auto [x, y] = stack.back();
        stack.pop_back();
        component.push_back({x, y});
        if (below[at(x, y)] >= 0) ++deep;
        sum_x += x;
        sum_y += y;
        touches_side = touches_side || x == 0 || x == w - 1 || y == 0 || y == h - 1;
        constexpr std::array<std::pair<int, int>, 4> sides = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
        for (const auto& [dx, dy] : sides) {
          const int nx = x + dx, ny = y + dy;
          if (nx < 0 || ny < 0 || nx >= w || ny >= h || seen[at(nx, ny)]) continue;
          const float b = below[at(nx, ny)];
          if (b >= 0 && !(static_cast<double>(b) > threshold_mm)) continue;
          seen[at(nx, ny)] = 1;
          stack.push_back({nx, ny});
        }
      }
      // A mouth lies about the middle; what lies in a corner is the jaw's edge.
      const double size = static_cast<double>(component.size());
      const double off = std::hypot((sum_x / size / w - 0.5) / 0.5, (sum_y / size / h - 0.5) / 0.5);
      if (deep < 4 || touches_side || off > 0.8) continue;
      for (const auto& [x, y] : component) inside[at(x, y)] = 1;
    }
  return inside;
}

// Closes gaps of up to two pixels between marks of a column: a tooth's noise.
void close_columns(std::vector<std::uint8_t>& inside, const Rectangle& box) {
  for (int x = 0; x < box.width; ++x) {
    int last = -10;
    for (int y = 0; y < box.height; ++y) {
      if (!inside[static_cast<std::size_t>(y * box.width + x)]) continue;
      if (y - last > 1 && y - last <= 3)
        for (int k = last + 1; k < y; ++k) inside[static_cast<std::size_t>(k * box.width + x)] = 1;
      last = y;
    }
  }
}

double grey_at(const Image& picture, int x, int y) {
  x = std::clamp(x, 0, picture.width - 1);
  y = std::clamp(y, 0, picture.height - 1);
  const std::uint8_t* p = picture.pixels.data() +
                          static_cast<std::size_t>(y * picture.width + x) * static_cast<std::size_t>(picture.channels);
  return grey_value<double>(p, picture.channels);
}

// Moves upper and lower end of every run of a column to the steepest step of grey within two pixels.
void move_to_edges(const DepthScan& scan, const Rectangle& box, std::vector<std::uint8_t>& inside) {
  const std::vector<std::uint8_t> source = inside;
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * box.width + x); };
  const auto step = [&](int x, int y) {  // between pixel y - 1 and y
    return std::fabs(grey_at(scan.picture, box.left + x, box.top + y) -
                     grey_at(scan.picture, box.left + x, box.top + y - 1));
  };
  for (int x = 0; x < box.width; ++x)
    for (int y = 1; y < box.height; ++y) {
      if (source[at(x, y)] == source[at(x, y - 1)]) continue;
      int best = y;
      for (int k = -2; k <= 2; ++k)
        if (y + k >= 1 && y + k < box.height && step(x, y + k) > step(x, best) + 4) best = y + k;
      const bool begins = source[at(x, y)] != 0;
      for (int k = std::min(best, y); k < std::max(best, y); ++k) inside[at(x, k)] = begins ? best < y : best > y;
    }
}

// Follows the slit into the corners of the mouth, where teeth lie so close behind the lips that depth alone does not
// tell: from a column's run outwards, column by column, what is clearly brighter than both lips and lies a little
// behind the band. Gaps between teeth are stepped over.
void follow_into_corners(const DepthScan& scan, const Rectangle& box, const std::vector<float>& below,
                         double threshold_mm, std::vector<std::uint8_t>& inside) {
  constexpr double least_contrast = 15;   // grey levels between teeth and lips
  constexpr double share_of_depth = 0.2;  // of the threshold
  constexpr int lip_px = 3;               // from the edge, where a lip has its own grey
  constexpr int widest_gap_px = 2;
  struct Run {
    int top, bottom;  // bounds included
  };
  const std::vector<std::uint8_t> source = inside;
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * box.width + x); };
  const auto grey = [&](int x, int y) { return grey_at(scan.picture, box.left + x, box.top + y); };
  const auto run_of = [&](int x) {
    Run run{-1, -1};
    for (int y = 0; y < box.height; ++y) {
      if (!source[at(x, y)]) continue;
      if (run.top < 0) run.top = y;
      run.bottom = y;
    }
    return run;
  };
  // What continues a run in the next column; top is -1 where nothing does.
  const auto continued = [&](const Run& run, int x) {
    Run next{-1, -1};
    const double lips = std::max(grey(x, run.top - lip_px), grey(x, run.bottom + lip_px));
    for (int y = std::max(run.top - 1, lip_px); y <= std::min(run.bottom + 1, box.height - 1 - lip_px); ++y) {
      const auto depth = static_cast<double>(below[at(x, y)]);
      if ((depth >= 0 && depth < share_of_depth * threshold_mm) || grey(x, y) < lips + least_contrast) continue;
      if (next.top < 0) next.top = y;
      next.bottom = y;
    }
    return next;
  };
  for (const int side : {-1, 1})
    for (int start = 0; start < box.width; ++start) {
      Run run = run_of(start);
      if (run.top < lip_px || run.bottom + lip_px >= box.height) continue;
      int gap = 0;
      for (int x = start + side; x >= 0 && x < box.width && gap <= widest_gap_px && run_of(x).top < 0; x += side) {
        const Run next = continued(run, x);
        ++gap;
        if (next.top < 0) continue;
        for (; gap > 0; --gap)
          for (int y = next.top; y <= next.bottom; ++y) inside[at(x - side * (gap - 1), y)] = 1;
        run = next;
      }
    }
}

double area_of(const std::vector<std::uint8_t>& inside) {
  return static_cast<double>(std::count(inside.begin(), inside.end(), 1));
}

}  // namespace

RemoveMouthResult remove_mouth(const DepthScan& scan, const Landmarks* moved, const Landmarks* before,
                               const RemoveMouthOptions& options) {
  check_scan(scan, "scan");
  check(options.threshold_mm > 0, "threshold_mm is ", options.threshold_mm, ", expected more than 0");
  const Rectangle box = rectangle_of(scan, moved, before, options);
  const std::vector<float> below = depth_below_band(scan, box);
  const auto marks_at = [&](double threshold_mm) {
    std::vector<std::uint8_t> inside = inside_of(below, box, threshold_mm);
    close_columns(inside, box);
    return inside;
  };
  std::vector<std::uint8_t> inside = marks_at(options.threshold_mm);
  const double area = area_of(inside);

  // Areas at thresholds in a geometric row; the proposal is where a step of the row changes the area least, of those at
  // which something is removed (the nearest to the default where several are equal).
  std::vector<double> thresholds, areas;
  for (int k = -8; k <= 6; ++k) {
    thresholds.push_back(RemoveMouthOptions{}.threshold_mm * std::pow(2.0, k / 4.0));
    areas.push_back(area_of(marks_at(thresholds.back())));
  }
  double least = 1e30, proposed = options.threshold_mm;
  for (std::size_t k = 1; k + 1 < areas.size(); ++k) {
    if (areas[k] == 0) continue;
    const double change = std::fabs(areas[k + 1] - areas[k - 1]) / std::max(areas[k], 30.0) +
                          0.01 * std::fabs(std::log(thresholds[k] / RemoveMouthOptions{}.threshold_mm));
    if (change < least) least = change, proposed = thresholds[k];
  }

  move_to_edges(scan, box, inside);
  follow_into_corners(scan, box, below, options.threshold_mm, inside);
  RemoveMouthResult result{scan, {scan.picture.width, scan.picture.height, 1, {}}, {}};
  result.interior.pixels.assign(scan.depth_mm.size(), 0);
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      if (!inside[static_cast<std::size_t>(y * box.width + x)]) continue;
      const auto i = static_cast<std::size_t>((box.top + y) * scan.picture.width + box.left + x);
      result.scan.depth_mm[i] = 0;
      result.interior.pixels[i] = 255;
    }
  result.report.columns = {"threshold_mm", "area_px", "area_low_px", "area_high_px", "proposed_mm"};
  result.report.rows = {{"frame",
                         {options.threshold_mm, area, area_of(marks_at(0.75 * options.threshold_mm)),
                          area_of(marks_at(options.threshold_mm / 0.75)), proposed}}};
  return result;
}

}  // namespace face::mask
