// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/phantom/make_lighting.h"
#include "nodes/phantom/person_random.h"
#include "nodes/render/camera.h"

namespace face::phantom {
namespace {

constexpr double face_height_share = 0.5;  // of the picture, by a face of this height
constexpr double face_height_mm = 180;
constexpr double focus_mm = 80;  // the face lies about this far before the head's middle

}  // namespace

MakeViewResult make_view(const Rig& rig, const std::string* id, const MakeViewOptions& options) {
  check(options.nearest_mm > 2 * focus_mm, "nearest_mm is ", options.nearest_mm, ", expected more than ", 2 * focus_mm);
  check(options.farthest_mm >= options.nearest_mm, "farthest_mm is ", options.farthest_mm,
        ", expected at least nearest_mm, ", options.nearest_mm);
  const std::int64_t seed = person_seed(options.seed, id);
  MakeViewResult result;

  Random place = series(seed, 20);
  constexpr double degree = std::numbers::pi / 180;
  const double yaw = options.turn_deg * place.uniform(-1, 1) * degree;
  const double pitch = options.nod_deg * place.uniform(-1, 1) * degree;
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  result.world_from_head.rotation = {cy, 0, sy, sp * sy, cp, -sp * cy, -cp * sy, sp, cp * cy};
  const double distance = place.uniform(options.nearest_mm, options.farthest_mm);
  const double half = 0.5 * face_height_mm / face_height_share / (distance - focus_mm);
  result.camera =
      render::orbit_camera({0, 10, 0}, static_cast<float>(distance), 0, 0,
                           static_cast<float>(2 * std::atan(half) / degree), options.width_px, options.height_px);

  Random light = series(seed, 21);
  MakeLightingOptions lamp;
  lamp.yaw_deg = options.light_turn_deg * light.uniform(-1, 1);
  lamp.pitch_deg = light.uniform(-5, 50);
  const double strength = light.uniform(0.7, 1.25);
  lamp.parallel_red *= strength;
  lamp.parallel_green *= strength;
  lamp.parallel_blue *= strength * light.uniform(0.85, 1.1);
  result.lighting = make_lighting(lamp);

  Random mouth = series(seed, 22);
  result.weights.values.assign(rig.shapes.size(), 0.0f);
  const bool is_open = mouth.uniform() < options.open_share;
  const double jaw = mouth.uniform(0.15, 0.5);
  if (!is_open) return result;
  const auto found =
      std::find_if(rig.shapes.begin(), rig.shapes.end(), [](const Shape& shape) { return shape.name == "jawOpen"; });
  check(found != rig.shapes.end(), "the rig has no shape jawOpen; set open_share to 0");
  result.weights.values[static_cast<std::size_t>(found - rig.shapes.begin())] = static_cast<float>(jaw);
  return result;
}

}  // namespace face::phantom
