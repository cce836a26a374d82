// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/scan_camera_file.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>

#include "nodes/base/check.h"
#include "nodes/base/edit_distance.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/json_file.h"

namespace face::decode {
namespace {

using Json = nlohmann::ordered_json;

double number_of(const Json& json, const char* key, double otherwise, const std::string& title) {
  return json.contains(key) ? json_number(json[key], title, std::string("/") + key) : otherwise;
}

double positive_of(const Json& json, const char* key, double otherwise, const std::string& title) {
  const double value = number_of(json, key, otherwise, title);
  if (!(value > 0)) fail(title, " at /", key, ": found ", value, ", expected more than 0");
  return value;
}

int whole_of(const Json& json, const char* key, int otherwise, int most, const std::string& title) {
  const double value = number_of(json, key, otherwise, title);
  if (json.contains(key) && !(value >= 1 && value <= most && value == std::floor(value)))
    fail(title, " at /", key, ": found ", value, ", expected a whole number from 1 to ", most);
  return static_cast<int>(value);
}

template <class Numbers>
void numbers_of(const Json& json, const char* key, const std::string& title, Numbers& out) {
  if (!json.contains(key)) return;
  const Json& list = json[key];
  if (!list.is_array() || list.size() != out.size())
    fail(title, " at /", key, ": found ", describe_json(list), ", expected ", out.size(), " numbers");
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<float>(json_number(list[i], title, message("/", key, "/", i)));
}

// Numbers of a file have few digits.
void check_rotation(const std::array<float, 9>& m, const std::string& title) {
  constexpr float rounding = 1e-3f;
  bool rigid = true;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      float product = 0;
      for (std::size_t k = 0; k < 3; ++k) product += m[3 * a + k] * m[3 * b + k];
      rigid = rigid && std::fabs(product - (a == b ? 1.0f : 0.0f)) < rounding;
    }
  const float volume =
      m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
  if (!rigid || volume < 0)
    fail(title, " at /cam_from_world: found a matrix that ", rigid ? "mirrors" : "stretches or shears",
         ", expected a rotation (three rows of length 1 at right angles to each other)");
}

double length_unit_of(const Json& json, const std::string& title) {
  if (!json.contains("length_unit")) return 1;
  const Json& unit = json["length_unit"];
  const std::string name = unit.is_string() ? unit.get<std::string>() : std::string();
  if (name == "mm") return 1;
  if (name == "cm") return 10;
  if (name == "m") return 1000;
  fail(title, " at /length_unit: found ", describe_json(json["length_unit"]), R"(, expected "mm", "cm" or "m")");
}

// A key that is one or two letters beside one that counts would be left out without a word.
void check_keys(const Json& json, const std::string& title) {
  constexpr std::array<std::string_view, 8> keys = {"depth_unit_mm", "length_unit", "rate_hz",     "mask_value",
                                                    "width",         "height",      "position_mm", "cam_from_world"};
  for (const auto& [name, value] : json.items())
    for (const std::string_view key : keys)
      if (name != key && !json.contains(std::string(key)) && edit_distance(name, key) <= 2)
        fail(title, " at /", name, ": no such key, expected \"", key, "\"");
}

void check_view(double focal_px, double centre_px, int size_px, const char* along, const std::string& title) {
  if (size_px == 0) return;
  const double view_deg = 2 * std::atan(0.5 * size_px / focal_px) * 180 / std::numbers::pi;
  if (view_deg < 3 || view_deg > 150)
    fail(title, ": a focal length of ", focal_px, " px over ", size_px, " px of ", along, " is a field of view of ",
         std::round(10 * view_deg) / 10, " degrees, expected 3 to 150");
  if (centre_px < 0 || centre_px > size_px - 1)
    fail(title, ": the centre is at ", centre_px, " px of ", along, ", expected a place in the picture, 0 to ",
         size_px - 1);
}

}  // namespace

ScanCameraFile read_scan_camera(const engine::File& file) {
  const std::string title = title_of(file);
  const Json json = read_json(file);
  ScanCameraFile out;
  const double fx = json_number(json_member(json, "fx", title, ""), title, "/fx");
  const double fy = number_of(json, "fy", fx, title);
  if (!(fx > 0) || !(fy > 0)) fail(title, ": fx is ", fx, " and fy ", fy, " px, expected both more than 0");
  const double cx = json_number(json_member(json, "cx", title, ""), title, "/cx");
  const double cy = json_number(json_member(json, "cy", title, ""), title, "/cy");
  constexpr int most_px = 100000, most_grey = 65535;
  out.width_px = whole_of(json, "width", 0, most_px, title);
  out.height_px = whole_of(json, "height", 0, most_px, title);
  check_view(fx, cx, out.width_px, "width", title);
  check_view(fy, cy, out.height_px, "height", title);
  for (const char* key : {"distortion", "dist_coeffs", "distortion_coefficients"})
    if (json.contains(key) && json[key].is_array())
      for (const Json& value : json[key])
        if (value.is_number() && value.get<double>() != 0)
          fail(title, " at /", key, ": found ", describe_json(json[key]),
               ", expected zeros: undistort depth and pictures first");
  if (json.contains("depth_scale"))
    fail(title,
         " at /depth_scale: some programs mean metres per unit by it and some units per metre; expected "
         "\"depth_unit_mm\", the mm of one unit");
  check_keys(json, title);
  out.says_depth_unit = json.contains("depth_unit_mm");
  out.says_length_unit = json.contains("length_unit");
  out.says_rate = json.contains("rate_hz");
  out.depth_unit_mm = positive_of(json, "depth_unit_mm", 1, title);
  out.length_unit_mm = length_unit_of(json, title);
  out.rate_hz = positive_of(json, "rate_hz", 40, title);
  out.mask_from = whole_of(json, "mask_value", 1, most_grey, title);
  out.camera.focal_px = static_cast<float>(fx);
  out.camera.centre_x_px = static_cast<float>(cx);
  out.camera.centre_y_px = static_cast<float>(cy);
  out.aspect = fy / fx;
  if (out.aspect < 0.5 || out.aspect > 2)
    fail(title, ": fx is ", fx, " and fy ", fy, " px, expected pixels less than twice as high as wide, or the reverse");
  out.camera.position_mm = {0, 0, 0};
  numbers_of(json, "cam_from_world", title, out.camera.cam_from_world);
  check_rotation(out.camera.cam_from_world, title);
  numbers_of(json, "position_mm", title, out.camera.position_mm);
  return out;
}

}  // namespace face::decode
