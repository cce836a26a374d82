// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_lighting.h"

#include <cmath>
#include <numbers>

namespace face::phantom {
namespace {

Vec3f rgb(double red, double green, double blue) {
  return {static_cast<float>(red), static_cast<float>(green), static_cast<float>(blue)};
}

}  // namespace

Lighting make_lighting(const MakeLightingOptions& options) {
  const double yaw = options.yaw_deg * std::numbers::pi / 180, pitch = options.pitch_deg * std::numbers::pi / 180;
  Lighting lighting;
  lighting.towards_light = rgb(std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch));
  lighting.parallel = rgb(options.parallel_red, options.parallel_green, options.parallel_blue);
  lighting.ambient = rgb(options.ambient_red, options.ambient_green, options.ambient_blue);
  lighting.contrast = static_cast<float>(options.contrast);
  lighting.gain = rgb(options.gain_red, options.gain_green, options.gain_blue);
  lighting.offset = rgb(options.offset_red, options.offset_green, options.offset_blue);
  return lighting;
}

}  // namespace face::phantom
