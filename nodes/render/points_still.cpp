// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/points_still.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/render/draw_landmarks.h"

namespace face::render {
namespace {

constexpr int side_px = 360, margin_px = 16;
constexpr std::uint8_t paper = 28;

Image blank(int width, int height) {
  Image image{width, height, 3, {}};
  image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, paper);
  return image;
}

struct Range {
  double low = 0, high = 0;
  bool empty = true;
  void add(double value) {
    low = empty ? value : std::min(low, value);
    high = empty ? value : std::max(high, value);
    empty = false;
  }
  double size() const { return high - low; }
  double middle() const { return (low + high) / 2; }
};

bool finite(const Vec3f& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

// One dot of 2 x 2 pixels per point, seen along -z, in the square that begins at left_px.
void draw(Image& image, int left_px, const std::vector<Vec3f>& seen) {
  Range x, y, z;
  for (const Vec3f& p : seen) x.add(p[0]), y.add(p[1]), z.add(p[2]);
  const double size = std::max({x.size(), y.size(), 1e-9});
  const double scale = (side_px - 2 * margin_px) / size;
  std::vector<Vec3f> far_first = seen;
  std::stable_sort(far_first.begin(), far_first.end(), [](const Vec3f& a, const Vec3f& b) { return a[2] < b[2]; });
  for (const Vec3f& p : far_first) {
    const int px = left_px + static_cast<int>(std::lround(side_px / 2.0 + (p[0] - x.middle()) * scale));
    const int py = static_cast<int>(std::lround(side_px / 2.0 - (p[1] - y.middle()) * scale));
    const double near = z.size() > 0 ? (p[2] - z.low) / z.size() : 1;
    const auto level = static_cast<std::uint8_t>(std::lround(70 + 180 * near));
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        if (px + i < 0 || py + j < 0 || px + i >= image.width || py + j >= image.height) continue;
        const auto at = 3 * (static_cast<std::size_t>(py + j) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(px + i));
        image.pixels[at] = static_cast<std::uint8_t>(level * 0.7), image.pixels[at + 1] = level;
        image.pixels[at + 2] = level;
      }
  }
}

}  // namespace

Image points_still(const MeshPoints& points) {
  Image image = blank(2 * side_px, side_px);
  std::vector<Vec3f> front, left;
  for (const Vec3f& p : points.points_mm) {
    if (!finite(p)) continue;
    front.push_back(p);
    left.push_back({-p[2], p[1], p[0]});
  }
  draw(image, 0, front);
  draw(image, side_px, left);
  return image;
}

Image landmarks_still(const Landmarks& landmarks) {
  Range x, y;
  for (const Landmark& p : landmarks.points)
    if (std::isfinite(p.x_px) && std::isfinite(p.y_px)) x.add(p.x_px), y.add(p.y_px);
  const double scale = std::min(1.0, (2.0 * side_px - 2 * margin_px) / std::max({x.size(), y.size(), 1e-9}));
  Landmarks moved = landmarks;
  for (Landmark& p : moved.points)
    p.x_px = (p.x_px - x.low) * scale + margin_px, p.y_px = (p.y_px - y.low) * scale + margin_px;
  const int width = static_cast<int>(std::ceil(x.size() * scale)) + 2 * margin_px;
  const int height = static_cast<int>(std::ceil(y.size() * scale)) + 2 * margin_px;
  return draw_landmarks(blank(width, height), moved);
}

}  // namespace face::render
