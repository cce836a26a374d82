// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_camera.h"

#include "nodes/render/camera.h"

namespace face::phantom {

Camera make_camera(const MakeCameraOptions& options) {
  const Vec3f target = {static_cast<float>(options.target_x_mm), static_cast<float>(options.target_y_mm),
                        static_cast<float>(options.target_z_mm)};
  return render::orbit_camera(target, static_cast<float>(options.distance_mm), static_cast<float>(options.yaw_deg),
                              static_cast<float>(options.pitch_deg), static_cast<float>(options.field_of_view_deg),
                              options.width_px, options.height_px);
}

}  // namespace face::phantom
