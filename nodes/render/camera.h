// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/types/camera.h"
#include "nodes/types/vec.h"

namespace face::render {

// A camera that orbits a point: at yaw 0 and pitch 0 it stands on the +z side and looks along -z; a positive yaw moves
// it to +x (the head's left side comes into view), a positive pitch moves it up. field_of_view_deg is the vertical one.
Camera orbit_camera(const Vec3f& target_mm, float distance_mm, float yaw_deg, float pitch_deg, float field_of_view_deg,
                    int width_px, int height_px);

// The camera whose every pixel is split into factor x factor.
Camera supersampled(const Camera& camera, int factor);

ScreenPoint project(const Camera& camera, const Vec3f& point_mm);
std::vector<ScreenPoint> project(const Camera& camera, const std::vector<Vec3f>& points_mm);

}  // namespace face::render
