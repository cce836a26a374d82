// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/cylinder_scan.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/decode/depth_image.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/json_file.h"

namespace face::decode {
namespace {

Vec3f triple(const nlohmann::ordered_json& json, const char* key, const std::string& title) {
  const nlohmann::ordered_json& value = json_member(json, key, title, "");
  const std::string pointer = std::string("/") + key;
  if (!value.is_array() || value.size() != 3)
    fail(title, " at ", pointer, ": found ", describe_json(value), ", expected [x, y, z]");
  Vec3f out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<float>(json_number(value[k], title, pointer + "/" + std::to_string(k)));
  return out;
}

double above_zero(const nlohmann::ordered_json& json, const char* key, const std::string& title) {
  const double value = json_number(json_member(json, key, title, ""), title, std::string("/") + key);
  check(value > 0, title, " at /", key, ": found ", value, ", expected more than 0");
  return value;
}

}  // namespace

CylinderScan cylinder_scan(const engine::File& header, const engine::File& radius, const engine::File& colour) {
  const std::string title = title_of(header);
  const nlohmann::ordered_json json = read_json(header);
  CylinderScan scan;
  scan.axis.origin_mm = triple(json, "axis_origin_mm", title);
  scan.axis.direction = triple(json, "axis_direction", title);
  const Vec3f& d = scan.axis.direction;
  const float length = std::hypot(d[0], d[1], d[2]);
  check(std::abs(length - 1) < 1e-3f, title, " at /axis_direction: found a length of ", length, ", expected 1");
  scan.top_mm = static_cast<float>(json_number(json_member(json, "top_mm", title, ""), title, "/top_mm"));
  scan.step_mm = static_cast<float>(above_zero(json, "step_mm", title));
  const double unit_mm = above_zero(json, "radius_unit_mm", title);
  const DepthImage radii = read_depth_image(radius.path(), title_of(radius));
  scan.picture = read_picture(colour.path(), title_of(colour));
  check(scan.picture.width == radii.width && scan.picture.height == radii.height, title_of(colour), ": is ",
        scan.picture.width, " x ", scan.picture.height, " pixels, the radii of ", title_of(radius), " are ",
        radii.width, " x ", radii.height);
  if (scan.picture.channels == 1) {
    std::vector<std::uint8_t> rgb;
    for (const std::uint8_t grey : scan.picture.pixels) rgb.insert(rgb.end(), 3, grey);
    scan.picture.pixels = std::move(rgb);
    scan.picture.channels = 3;
  }
  const double phi_step = json.contains("phi_step_deg") ? above_zero(json, "phi_step_deg", title) : 360.0 / radii.width;
  check(phi_step * radii.width < 360.5, title, " at /phi_step_deg: found ", phi_step, " for ", radii.width,
        " columns, expected at most one full turn");
  scan.phi_step_rad = static_cast<float>(phi_step * std::numbers::pi / 180);
  for (const float value : radii.values)
    scan.radius_mm.push_back(
        std::isfinite(value) && value > 0 ? static_cast<float>(static_cast<double>(value) * unit_mm) : 0.0f);
  return scan;
}

}  // namespace face::decode
