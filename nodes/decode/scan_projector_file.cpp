// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/scan_projector_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/json_file.h"
#include "nodes/decode/scan_camera_file.h"

namespace face::decode {

ScanProjectorFile read_scan_projector(const engine::File& file) {
  const std::string title = title_of(file);
  const ScanCameraFile as_camera = read_scan_camera(file);
  check(as_camera.width_px > 0, title, ": has no width, the pixels over which the fringes lie");
  check(std::fabs(as_camera.aspect - 1) < 1e-4, title, ": fy is ", as_camera.aspect,
        " times fx, expected pixels as high as wide");
  ScanProjectorFile out;
  out.projector = as_camera.camera;
  out.options.projector_width_px = as_camera.width_px;
  const nlohmann::ordered_json json = read_json(file);
  const auto positive = [&](const char* key, auto& value) {
    if (!json.contains(key)) return;
    const double found = json_number(json[key], title, std::string("/") + key);
    if (!(found > 0)) fail(title, " at /", key, ": found ", found, ", expected more than 0");
    value = static_cast<std::remove_reference_t<decltype(value)>>(found);
  };
  positive("fine_periods", out.options.fine_periods);
  positive("coarse_periods", out.options.coarse_periods);
  positive("min_amplitude", out.options.min_amplitude);
  positive("near_mm", out.options.near_mm);
  positive("far_mm", out.options.far_mm);
  check(out.options.near_mm < out.options.far_mm, title, ": near_mm is ", out.options.near_mm, " and far_mm ",
        out.options.far_mm, ", expected near_mm to be less");
  return out;
}

}  // namespace face::decode
