// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/crop.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"

namespace face::align {
namespace {

struct Cell {
  int row = -1, column = -1;
};

Cell cell_of(const Axis& axis, const Vec3f& point_mm, const CoverOptions& options) {
  const CylinderPlace place = cylinder_place(axis, point_mm);
  const double row = (options.top_mm - place.h_mm) / options.step_mm;
  const double column = (place.phi_rad / std::numbers::pi + 0.5) * static_cast<double>(options.columns);
  if (!(row >= 0 && column >= 0 && row < static_cast<double>(options.rows) &&
        column < static_cast<double>(options.columns)))
    return {};
  return {static_cast<int>(row), static_cast<int>(column)};
}

// Largest (or smallest) value within a square of 2 radius + 1 cells.
Image spread(const Image& in, int radius, bool largest) {
  Image out = in;
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      std::uint8_t value = largest ? 0 : 255;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
          const int nx = x + dx, ny = y + dy;
          // Outside counts as nothing, for both.
          const bool inside = nx >= 0 && ny >= 0 && nx < in.width && ny < in.height;
          const std::uint8_t v = inside ? in.pixels[static_cast<std::size_t>(ny * in.width + nx)] : std::uint8_t{0};
          value = largest ? std::max(value, v) : std::min(value, v);
        }
      out.pixels[static_cast<std::size_t>(y * in.width + x)] = value;
    }
  return out;
}

}  // namespace

Image cover(const DepthScan& scan, const Axis& axis, const CoverOptions& options) {
  check_scan(scan, "scan");
  Image mask{static_cast<int>(options.columns), static_cast<int>(options.rows), 1, {}};
  mask.pixels.assign(static_cast<std::size_t>(options.columns * options.rows), 0);
  const ScanRays rays(scan.camera);
  std::size_t i = 0;
  for (int y = 0; y < scan.picture.height; ++y)
    for (int x = 0; x < scan.picture.width; ++x, ++i) {
      if (!(scan.depth_mm[i] > 0)) continue;
      const Cell cell = cell_of(axis, rays.point(x, y, scan.depth_mm[i]), options);
      if (cell.row >= 0) mask.pixels[static_cast<std::size_t>(cell.row * mask.width + cell.column)] = 255;
    }
  return spread(spread(mask, 1, true), 1, false);
}

Image common_cover(const engine::Seq<Image>& covers, const CommonCoverOptions& options) {
  check(!covers.empty(), "covers is empty, expected at least one scan");
  std::vector<std::size_t> counts;
  Image common;
  for (std::size_t t = 0; t < covers.size(); ++t) {
    const auto mask = covers.at(t);
    check(mask->channels == 1 &&
              mask->pixels.size() == static_cast<std::size_t>(mask->width) * static_cast<std::size_t>(mask->height),
          "cover of ", covers.id(t), " has ", mask->pixels.size(), " values in ", mask->channels,
          " channels, expected one for each of ", mask->width, " x ", mask->height, " cells");
    if (t == 0) {
      common = *mask;
      counts.assign(mask->pixels.size(), 0);
    }
    check(mask->width == common.width && mask->height == common.height, "cover of ", covers.id(t), " is ", mask->width,
          " x ", mask->height, " cells, that of ", covers.id(0), " ", common.width, " x ", common.height);
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += mask->pixels[i] >= 128 ? 1 : 0;
  }
  const double needed = options.share * static_cast<double>(covers.size()) - 1e-9;
  for (std::size_t i = 0; i < counts.size(); ++i) common.pixels[i] = static_cast<double>(counts[i]) >= needed ? 255 : 0;
  common = spread(common, static_cast<int>(options.shrink_cells), false);
  // The largest piece, by flooding.
  std::vector<int> label(counts.size(), 0);
  int next = 0, best = 0;
  std::size_t best_size = 0;
  for (std::size_t start = 0; start < counts.size(); ++start) {
    if (!common.pixels[start] || label[start]) continue;
    std::vector<std::size_t> stack = {start};
    label[start] = ++next;
    std::size_t size = 0;
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      ++size;
      const int x = static_cast<int>(at) % common.width, y = static_cast<int>(at) / common.width;
      for (int k = 0; k < 4; ++k) {
        const int nx = x + (k == 0) - (k == 1), ny = y + (k == 2) - (k == 3);
        if (nx < 0 || ny < 0 || nx >= common.width || ny >= common.height) continue;
        const auto n = static_cast<std::size_t>(ny * common.width + nx);
        if (!common.pixels[n] || label[n]) continue;
        label[n] = next;
        stack.push_back(n);
      }
    }
    if (size > best_size) best_size = size, best = next;
  }
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (label[i] != best) common.pixels[i] = 0;
  return common;
}

DepthScan crop(const DepthScan& scan, const Axis& axis, const Image& mask, const CoverOptions& options) {
  check_scan(scan, "scan");
  check(mask.width == options.columns && mask.height == options.rows, "mask is ", mask.width, " x ", mask.height,
        " cells, expected ", options.columns, " x ", options.rows);
  check(mask.channels == 1 && mask.pixels.size() == static_cast<std::size_t>(options.columns * options.rows),
        "mask has ", mask.pixels.size(), " values in ", mask.channels, " channels, expected one for each of ",
        options.columns, " x ", options.rows, " cells");
  DepthScan out = scan;
  const ScanRays rays(scan.camera);
  std::size_t i = 0;
  for (int y = 0; y < scan.picture.height; ++y)
    for (int x = 0; x < scan.picture.width; ++x, ++i) {
      if (!(scan.depth_mm[i] > 0)) continue;
      const Cell cell = cell_of(axis, rays.point(x, y, scan.depth_mm[i]), options);
      if (cell.row < 0 || mask.pixels[static_cast<std::size_t>(cell.row * mask.width + cell.column)] < 128)
        out.depth_mm[i] = 0;
    }
  return out;
}

}  // namespace face::align
