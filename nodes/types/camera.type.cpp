// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/camera.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Camera, "camera", codec_version{1}, doc{"A pinhole camera."}, field<&Camera::cam_from_world>(),
     field<&Camera::position_mm>(), field<&Camera::focal_px>(), field<&Camera::centre_x_px>(),
     field<&Camera::centre_y_px>());
