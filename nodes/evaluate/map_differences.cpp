// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/map_differences.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/srgb.h"
#include "nodes/evaluate/draw_text.h"
#include "nodes/evaluate/image_difference.h"
#include "nodes/evaluate/statistics.h"
#include "nodes/render/rgb_image.h"

namespace face::evaluate {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr int gap_px = 8;

// Differences over pixels, and who alone knows how many.
struct Apart {
  std::vector<double> known;  // where both know
  std::vector<float> map;     // per pixel; 0 where not both know
  double only_a = 0, only_b = 0;

  void add(bool in_a, bool in_b, double difference) {
    // What is no number in one of them is infinitely far from the other.
    const double d = std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
    if (in_a && in_b) known.push_back(d);
    map.push_back(in_a && in_b ? static_cast<float>(d) : 0.0f);
    only_a += in_a && !in_b ? 1 : 0;
    only_b += in_b && !in_a ? 1 : 0;
  }
  std::vector<double> values() const {
    return {mean_of(known), quantile(known, 0.95), largest_of(known), only_a, only_b};
  }
};

bool same_size(const Image& a, const Image& b) { return a.width == b.width && a.height == b.height; }

// Both pictures, and the differences over the largest.
Image beside(const Image& a, const Image& b, const std::vector<float>& map) {
  const Image x = render::rgb_image(a), y = render::rgb_image(b);
  const bool drawn = !map.empty() && same_size(x, y);
  Canvas canvas(x.width + gap_px + y.width + (drawn ? gap_px + x.width : 0), std::max({x.height, y.height, 1}));
  canvas.paste(x, 0, 0);
  canvas.paste(y, x.width + gap_px, 0);
  if (!drawn) return canvas.image();
  float largest = 0;
  for (const float d : map)
    if (std::isfinite(d)) largest = std::max(largest, d);
  Image apart{x.width, x.height, 3, {}};
  for (const float d : map) {
    const float share = largest > 0 ? std::min(d / largest, 1.0f) : (d > 0 ? 1.0f : 0.0f);
    apart.pixels.insert(apart.pixels.end(), 3, static_cast<std::uint8_t>(std::lround(255 * share)));
  }
  canvas.paste(apart, x.width + gap_px + y.width + gap_px, 0);
  return canvas.image();
}

// What scans have in common: a length and a picture's value per pixel.
MapDifferenceResult scan_difference(const Image& a, const std::vector<float>& lengths_a, const Image& b,
                                    const std::vector<float>& lengths_b, bool same_frame, const char* frame,
                                    const char* name) {
  for (const auto& [image, lengths] : {std::pair{&a, &lengths_a}, std::pair{&b, &lengths_b}})
    check(lengths->size() == static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height), name,
          " has ", lengths->size(), " values, its picture is ", image->width, " x ", image->height, " pixels");
  const std::vector<std::string> columns = {
      "mean_mm", "p95_mm", "largest_mm", "only_in_a", "only_in_b", "picture_rms_levels", frame};
  Apart apart;
  std::vector<double> values(6, nothing);
  if (same_size(a, b)) {
    for (std::size_t i = 0; i < lengths_a.size(); ++i)
      apart.add(lengths_a[i] != 0, lengths_b[i] != 0,
                std::fabs(static_cast<double>(lengths_a[i]) - static_cast<double>(lengths_b[i])));
    values = apart.values();
    values.push_back(image_difference(a, b).table.rows[0].values[0]);
  }
  values.push_back(same_frame ? 1 : 0);
  return {one_row("all", columns, values), beside(a, b, apart.map)};
}

bool same_axis(const Axis& a, const Axis& b) { return a.origin_mm == b.origin_mm && a.direction == b.direction; }

// As it is seen under white light.
Image picture_of(const AlbedoMap& map) {
  Image image{map.width, map.height, 3, {}};
  for (const Vec3f& colour : map.albedo)
    for (const float value : colour)
      image.pixels.push_back(static_cast<std::uint8_t>(
          std::isfinite(value) ? std::lround(255 * srgb_of(std::clamp(static_cast<double>(value), 0.0, 1.0))) : 0));
  return image;
}

void check_albedo(const AlbedoMap& map, const char* name) {
  const auto size = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  check(map.width >= 0 && map.height >= 0 && map.albedo.size() == size && map.weight.size() == size, name, " has ",
        map.albedo.size(), " colours and ", map.weight.size(), " weights, expected ", map.width, " x ", map.height);
}

}  // namespace

MapDifferenceResult depth_scan_difference(const DepthScan& a, const DepthScan& b) {
  const Camera &c = a.camera, &d = b.camera;
  const bool same =
      std::equal(std::begin(c.cam_from_world), std::end(c.cam_from_world), std::begin(d.cam_from_world)) &&
      std::equal(std::begin(c.position_mm), std::end(c.position_mm), std::begin(d.position_mm)) &&
      c.focal_px == d.focal_px && c.centre_x_px == d.centre_x_px && c.centre_y_px == d.centre_y_px;
  return scan_difference(a.picture, a.depth_mm, b.picture, b.depth_mm, same, "same_camera", "depth_mm");
}

MapDifferenceResult cylinder_scan_difference(const CylinderScan& a, const CylinderScan& b) {
  const bool same =
      same_axis(a.axis, b.axis) && a.top_mm == b.top_mm && a.step_mm == b.step_mm && a.phi_step_rad == b.phi_step_rad;
  return scan_difference(a.picture, a.radius_mm, b.picture, b.radius_mm, same, "same_grid", "radius_mm");
}

MapDifferenceResult albedo_difference(const AlbedoMap& a, const AlbedoMap& b) {
  check_albedo(a, "a");
  check_albedo(b, "b");
  std::vector<double> values(5, nothing);
  Apart apart;
  if (a.width == b.width && a.height == b.height) {
    for (std::size_t i = 0; i < a.albedo.size(); ++i) {
      double most = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = std::fabs(static_cast<double>(a.albedo[i][k]) - static_cast<double>(b.albedo[i][k]));
        most = std::isnan(d) ? d : std::max(most, d);
      }
      apart.add(true, true, most);
      apart.only_a += a.weight[i] > 0 && !(b.weight[i] > 0) ? 1 : 0;
      apart.only_b += b.weight[i] > 0 && !(a.weight[i] > 0) ? 1 : 0;
    }
    values = apart.values();
  }
  return {one_row("all", {"mean", "p95", "largest", "only_in_a", "only_in_b"}, values),
          beside(picture_of(a), picture_of(b), apart.map)};
}

}  // namespace face::evaluate
