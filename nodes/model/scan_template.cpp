// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/scan_template.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/model/cylinder_grid.h"
#include "nodes/model/scan_surface.h"
#include "nodes/model/skin_modes.h"

namespace face::model {
namespace {

constexpr double closed_px = 3;       // inner lips nearer than this are a closed mouth
constexpr int lip_reach_px = 4;       // how far the edge of the lips may be from the line through the points
constexpr int lip_seed_px = 9;        // how far colours about it are looked at
constexpr double nothing_seen = 0.1;  // of the skin's brightness
constexpr double darkest_cap = 0.6;   // of the skin's brightness
constexpr double radius_levels = 30;  // a step of 1 mm counts as much as this many grey levels

std::vector<cv::Point2f> points68(const Landmarks& landmarks) {
  std::vector<cv::Point2f> points(68);
  std::vector<bool> found(68, false);
  for (const Landmark& landmark : landmarks.points) {
    std::size_t number = 68;
    const char* end = landmark.name.data() + landmark.name.size();
    if (std::from_chars(landmark.name.data(), end, number).ptr != end || number >= 68) continue;
    points[number] = {static_cast<float>(landmark.x_px), static_cast<float>(landmark.y_px)};
    found[number] = true;
  }
  const auto missing = std::find(found.begin(), found.end(), false);
  check(missing == found.end(), "landmarks lack point ", missing - found.begin(), ", expected 0 to 67 (Multi-PIE)");
  return points;
}

// Radii with small holes (nostrils, below the chin) filled from their rims inwards.
CylinderScan filled(const CylinderScan& scan) {
  constexpr int deepest_px = 12;
  CylinderScan out = scan;
  const int width = scan.picture.width, height = scan.picture.height;
  for (int pass = 0; pass < deepest_px; ++pass) {
    const std::vector<float> before = out.radius_mm;
    const auto at = [&](int x, int y) {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    for (int y = 1; y + 1 < height; ++y)
      for (int x = 1; x + 1 < width; ++x) {
        if (before[at(x, y)] > 0) continue;
        float sum = 0;
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            if (const float radius = before[at(x + dx, y + dy)]; radius > 0) sum += radius, ++count;
        if (count >= 3) out.radius_mm[at(x, y)] = sum / static_cast<float>(count);
      }
  }
  return out;
}

// Whether a pixel is far behind one beside it: what is seen past the edge of a lip.
bool behind_lip(const CylinderScan& scan, int x, int y) {
  constexpr int beside_px = 2;
  constexpr float behind_mm = 6;
  const auto radius = [&](int column, int row) {
    return scan.radius_mm[static_cast<std::size_t>(row * scan.picture.width + column)];
  };
  for (int dy = -beside_px; dy <= beside_px; ++dy)
    for (int dx = -beside_px; dx <= beside_px; ++dx)
      if (radius(x + dx, y + dy) > radius(x, y) + behind_mm) return true;
  return false;
}

// The inside of the mouth, 255: the polygon of the inner lips, its edge moved to where what is seen changes. A pixel
// near the edge goes to the side that has the most alike pixel near by.
cv::Mat mouth_mask(const CylinderScan& scan, const std::vector<cv::Point2f>& points) {
  cv::Mat mask = cv::Mat::zeros(scan.picture.height, scan.picture.width, CV_8U);
  double gap = 0;
  for (std::size_t i = 61; i <= 63; ++i) gap = std::max<double>(gap, points[128 - i].y - points[i].y);
  if (gap < closed_px) return mask;
  std::vector<cv::Point> polygon;
  for (std::size_t i = 60; i < 68; ++i) polygon.emplace_back(cvRound(points[i].x), cvRound(points[i].y));
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{polygon}, cv::Scalar(255));
  cv::Mat inside, outside;
  cv::distanceTransform(mask, inside, cv::DIST_L2, 5);
  cv::distanceTransform(255 - mask, outside, cv::DIST_L2, 5);
  const auto feature = [&](int x, int y) {
    std::array<double, 4> f{};
    const auto i = static_cast<std::size_t>(y * scan.picture.width + x);
    for (std::size_t c = 0; c < 3; ++c) f[c] = scan.picture.pixels[3 * i + c];
    f[3] = radius_levels * static_cast<double>(scan.radius_mm[i]);
    return f;
  };
  cv::Mat result = mask.clone();
  for (int y = lip_seed_px; y + lip_seed_px < mask.rows; ++y)
    for (int x = lip_seed_px; x + lip_seed_px < mask.cols; ++x) {
      const float in = inside.at<float>(y, x), out = outside.at<float>(y, x);
      if (in > lip_reach_px || out > lip_reach_px) continue;
      const std::array<double, 4> here = feature(x, y);
      double nearest[2] = {1e30, 1e30};
      for (int dy = -lip_seed_px; dy <= lip_seed_px; ++dy)
        for (int dx = -lip_seed_px; dx <= lip_seed_px; ++dx) {
          const bool within = inside.at<float>(y + dy, x + dx) > 2;
          if (!within && outside.at<float>(y + dy, x + dx) <= 3) continue;
          const std::array<double, 4> there = feature(x + dx, y + dy);
          double d = 0.5 * (dx * dx + dy * dy);
          for (std::size_t c = 0; c < 4; ++c) d += (here[c] - there[c]) * (here[c] - there[c]);
          nearest[within ? 1 : 0] = std::min(nearest[within ? 1 : 0], d);
        }
      result.at<std::uint8_t>(y, x) = nearest[1] < nearest[0] ? 255 : 0;
    }
  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
  cv::morphologyEx(result, result, cv::MORPH_CLOSE, cross);
  cv::morphologyEx(result, result, cv::MORPH_OPEN, cross);
  for (int y = lip_seed_px; y + lip_seed_px < mask.rows; ++y)
    for (int x = lip_seed_px; x + lip_seed_px < mask.cols; ++x)
      if (outside.at<float>(y, x) <= lip_reach_px && behind_lip(scan, x, y)) result.at<std::uint8_t>(y, x) = 255;
  return result;
}

// The usual colour about a place: no marker, no mole.
std::array<double, 3> median_colour(const CylinderScan& scan, double x, double y) {
  constexpr int radius_px = 7;
  std::array<double, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> seen;
    for (int dy = -radius_px; dy <= radius_px; ++dy)
      for (int dx = -radius_px; dx <= radius_px; ++dx) seen.push_back(cylinder_colour(scan, x + dx, y + dy)[c]);
    colour[c] = median(std::move(seen));
  }
  return colour;
}

// First row of every column that is skin and not cap.
std::vector<int> cap_rows(const CylinderScan& scan, const std::vector<cv::Point2f>& points, int top, double tolerance) {
  std::vector<int> rows(static_cast<std::size_t>(scan.picture.width), top);
  if (tolerance <= 0) return rows;
  float brows = 1e9f;
  for (std::size_t i = 17; i < 27; ++i) brows = std::min(brows, points[i].y);
  const double forehead_y = brows - 0.25 * (points[27].y - brows) - 6;
  const std::array<double, 3> skin = median_colour(scan, points[27].x, forehead_y);
  const auto is_cap = [&](int x, int y) {
    const std::array<double, 3> colour = cylinder_colour(scan, x, y);
    double d = 0, grey = 0, skin_grey = 0;
    for (std::size_t c = 0; c < 3; ++c) grey += colour[c], skin_grey += skin[c];
    if (grey < nothing_seen * skin_grey) return true;
    if (grey < darkest_cap * skin_grey) return false;  // a marker, a brow
    // Hue, not lightness: a share of the sum.
    for (std::size_t c = 0; c < 3; ++c) d += std::abs(colour[c] * skin_grey / grey - skin[c]);
    return d > tolerance;
  };
  // Down from the top as long as it is cap.
  constexpr int sure_px = 4;
  for (int x = 0; x < scan.picture.width; ++x) {
    int last = -1, skin_run = 0;
    for (int y = top; y < cvRound(points[30].y) && skin_run < sure_px; ++y) {
      skin_run = is_cap(x, y) ? 0 : skin_run + 1;
      if (skin_run == 0) last = y;
    }
    if (last >= 0) rows[static_cast<std::size_t>(x)] = last + sure_px;
  }
  return rows;
}

std::uint32_t nearest_vertex(const Mesh& mesh, const CylinderScan& scan, const cv::Point2f& p) {
  std::uint32_t best = 0;
  double least = 1e30;
  for (std::uint32_t v = 0; v < mesh.uvs.size(); ++v) {
    const double x = static_cast<double>(mesh.uvs[v][0]) * scan.picture.width - 0.5,
                 y = static_cast<double>(1 - mesh.uvs[v][1]) * scan.picture.height - 0.5;
    const double d = (x - p.x) * (x - p.x) + (y - p.y) * (y - p.y);
    if (d < least) least = d, best = v;
  }
  return best;
}

// Drops what is not connected to the largest piece, and vertices without polygons.
void keep_largest(Mesh& mesh) {
  const std::size_t vertices = mesh.points_mm.size();
  std::vector<std::uint32_t> root(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) root[v] = v;
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (std::size_t c = 0; c + 2 < mesh.corners.size(); c += 3)
    for (std::size_t k = 1; k < 3; ++k) root[find(mesh.corners[c + k])] = find(mesh.corners[c]);
  std::vector<std::size_t> size(vertices, 0);
  for (const std::uint32_t v : mesh.corners) ++size[find(v)];
  const auto largest = static_cast<std::uint32_t>(std::max_element(size.begin(), size.end()) - size.begin());
  constexpr std::uint32_t unused = 0xffffffff;
  std::vector<std::uint32_t> number(vertices, unused);
  Mesh kept;
  std::vector<bool> used(vertices, false);
  for (const std::uint32_t v : mesh.corners) used[v] = find(v) == largest;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (!used[v]) continue;
    number[v] = static_cast<std::uint32_t>(kept.points_mm.size());
    kept.points_mm.push_back(mesh.points_mm[v]);
    kept.colors_srgb.push_back(mesh.colors_srgb[v]);
    kept.uvs.push_back(mesh.uvs[v]);
  }
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3) {
    if (number[mesh.corners[c]] == unused) continue;
    kept.polygon_starts.push_back(static_cast<std::uint32_t>(kept.corners.size()));
    for (std::size_t k = 0; k < 3; ++k) kept.corners.push_back(number[mesh.corners[c + k]]);
  }
  kept.polygon_starts.push_back(static_cast<std::uint32_t>(kept.corners.size()));
  mesh = std::move(kept);
}

// The row nearest to `from` on the way to `to`, both ends included, that the mouth takes; -1 where there is none.
int mouth_row(const cv::Mat& mouth, int x, int from, int to) {
  const int step = to < from ? -1 : 1;
  for (int y = from; y != to + step; y += step)
    if (mouth.at<std::uint8_t>(y, x) != 0) return y;
  return -1;
}

// Which pixels of a scan are vertices: every row_step_px-th row of every column_step_px-th column, those beside a mouth
// moved along their column to where it begins, so that lips end where they are seen to.
struct PixelGrid {
  int columns = 0, rows = 0;
  std::vector<cv::Point> place_px;  // rows x columns
  std::vector<bool> skin;           // whether there is a vertex
  std::vector<bool> cut;            // whether the mouth lies between it and the next one below

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

PixelGrid pixel_grid(const CylinderScan& scan, const cv::Mat& mouth, const std::vector<int>& first_row, int last_row,
                     const ScanTemplateOptions& options) {
  const int width = scan.picture.width, row_step_px = static_cast<int>(options.row_step_px),
            column_step_px = static_cast<int>(options.column_step_px);
  const int half =
      static_cast<int>(options.half_angle_deg * std::numbers::pi / 180 / static_cast<double>(scan.phi_step_rad));
  const int left = std::max(0, width / 2 - half / column_step_px * column_step_px),
            right = std::min(width - 1, width / 2 + half);
  const auto measured = [&](int x, int y) {
    return scan.radius_mm[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] >
           0;
  };
  PixelGrid grid;
  grid.columns = (right - left) / column_step_px + 1;
  grid.rows = scan.picture.height / row_step_px;
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const int x = left + c * column_step_px, y = r * row_step_px;
      grid.place_px.emplace_back(x, y);
      grid.skin.push_back(y >= first_row[static_cast<std::size_t>(x)] && y <= last_row && measured(x, y) &&
                          mouth.at<std::uint8_t>(y, x) == 0);
    }
  grid.cut.assign(grid.skin.size(), false);
  for (int r = 0; r + 1 < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const std::size_t above = grid.at(c, r), below = grid.at(c, r + 1);
      const int x = left + c * column_step_px, y = r * row_step_px;
      const int begins = mouth_row(mouth, x, y, y + row_step_px), ends = mouth_row(mouth, x, y + row_step_px, y);
      if (begins < 0) continue;
      grid.cut[above] = true;
      if (grid.skin[above] && measured(x, begins - 1)) grid.place_px[above].y = begins - 1;
      if (grid.skin[below] && measured(x, ends + 1)) grid.place_px[below].y = ends + 1;
    }
  return grid;
}

Mesh skin_mesh(const CylinderScan& scan, const cv::Mat& mouth, const std::vector<int>& first_row, int last_row,
               const ScanTemplateOptions& options) {
  const PixelGrid grid = pixel_grid(scan, mouth, first_row, last_row, options);
  Mesh mesh;
  std::vector<std::int32_t> vertex(grid.skin.size(), -1);
  for (std::size_t n = 0; n < grid.skin.size(); ++n) {
    if (!grid.skin[n]) continue;
    const cv::Point& at = grid.place_px[n];
    const auto i =
        static_cast<std::size_t>(at.y) * static_cast<std::size_t>(scan.picture.width) + static_cast<std::size_t>(at.x);
    vertex[n] = static_cast<std::int32_t>(mesh.points_mm.size());
    mesh.points_mm.push_back(cylinder_world(
        scan, {static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(scan.radius_mm[i])}));
    mesh.uvs.push_back({(static_cast<float>(at.x) + 0.5f) / static_cast<float>(scan.picture.width),
                        1 - (static_cast<float>(at.y) + 0.5f) / static_cast<float>(scan.picture.height)});
    Vec3f colour{};
    for (std::size_t k = 0; k < 3; ++k) colour[k] = static_cast<float>(scan.picture.pixels[3 * i + k]) / 255;
    mesh.colors_srgb.push_back(colour);
  }
  const auto near = [&](std::int32_t a, std::int32_t b) {
    const Vec3f &p = mesh.points_mm[static_cast<std::size_t>(a)], &q = mesh.points_mm[static_cast<std::size_t>(b)];
    return static_cast<double>(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2])) <= options.longest_edge_mm;
  };
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    if (a < 0 || b < 0 || c < 0 || !near(a, b) || !near(b, c) || !near(c, a)) return;
    for (const std::int32_t v : {a, b, c}) mesh.corners.push_back(static_cast<std::uint32_t>(v));
  };
  for (int r = 0; r + 1 < grid.rows; ++r)
    for (int c = 0; c + 1 < grid.columns; ++c) {
      // Counter-clockwise seen from outside: rows run downwards, columns to the head's left.
      const std::int32_t a = vertex[grid.at(c, r)], b = vertex[grid.at(c + 1, r)], d = vertex[grid.at(c, r + 1)],
                         e = vertex[grid.at(c + 1, r + 1)];
      const bool left_cut = grid.cut[grid.at(c, r)], right_cut = grid.cut[grid.at(c + 1, r)];
      if (left_cut && right_cut && a >= 0 && b >= 0 && d >= 0 && e >= 0) continue;
      // One diagonal or the other: the one that leaves no side of the mouth across skin.
      const bool falling = (a >= 0 && e >= 0 && (b < 0 || d < 0));
      if (falling) {
        if (!left_cut) add(a, d, e);
        if (!right_cut) add(a, e, b);
      } else {
        if (!left_cut) add(a, d, b);
        if (!right_cut) add(b, d, e);
      }
    }
  keep_largest(mesh);
  return mesh;
}

}  // namespace

MorphableModel scan_template(const CylinderScan& reference, const Landmarks& landmarks,
                             const ScanTemplateOptions& options) {
  check_cylinder(reference, "reference");
  check(options.row_step_px >= 1 && options.column_step_px >= 1, "strides are ", options.row_step_px, " and ",
        options.column_step_px, ", expected at least 1");
  const std::vector<cv::Point2f> points = points68(landmarks);
  const CylinderScan scan = filled(reference);
  float brows = 1e9f;
  for (std::size_t i = 17; i < 27; ++i) brows = std::min(brows, points[i].y);
  const double face = static_cast<double>(points[8].y - brows);
  check(face > 0, "landmarks have the chin in row ", points[8].y, ", above the brows in row ", brows);
  const int top = std::max(0, cvRound(static_cast<double>(brows) - options.top_share * face));
  const int bottom = cvRound(static_cast<double>(points[8].y) + options.bottom_share * face);
  const cv::Mat mouth = mouth_mask(scan, points);
  MorphableModel surface;
  surface.mean = skin_mesh(scan, mouth, cap_rows(scan, points, top, options.cap_tolerance), bottom, options);
  check(surface.mean.points_mm.size() >= 68, "the reference gives ", surface.mean.points_mm.size(),
        " vertices, expected at least 68: are the landmarks this scan's?");
  surface.mean.corner_uvs = surface.mean.corners;
  surface.mean.parts = {{"face", 0, static_cast<std::uint32_t>(surface.mean.polygon_count()), {1, 1, 1}, 0.25f, true}};
  surface.mean_albedo = vertex_albedo(surface.mean);
  for (const cv::Point2f& p : points) surface.landmarks68.push_back(nearest_vertex(surface.mean, scan, p));
  // Pairs of the lips: the ends of the hole in every column of its middle half.
  const std::vector<std::uint32_t> loop = mouth_loop(surface);
  if (cv::countNonZero(mouth) == 0 || loop.empty()) return surface;
  const float right = points[60].x, left = points[64].x;
  for (const LipPair& pair : lip_pairs(surface, loop)) {
    const float x = surface.mean.uvs[pair.upper][0] * static_cast<float>(scan.picture.width) - 0.5f;
    const float share = (x - right) / (left - right);
    if (share > 0.25f && share < 0.75f) surface.inner_lips.push_back(pair);
  }
  return surface;
}

}  // namespace face::model
