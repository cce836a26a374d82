// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/depth_scan.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(DepthScan, "depth_scan", codec_version{1}, doc{"One frame of a 3D scanner: depth at every pixel, and a picture."},
     field<&DepthScan::camera>(field<&Camera::cam_from_world>(), field<&Camera::position_mm>(),
                               field<&Camera::focal_px>(), field<&Camera::centre_x_px>(),
                               field<&Camera::centre_y_px>()),
     field<&DepthScan::picture>(field<&Image::width>(), field<&Image::height>(), field<&Image::channels>(),
                                field<&Image::pixels>()),
     field<&DepthScan::depth_mm>(), view{"png", "phantom.draw_scan"}, difference{"evaluate.depth_scan_difference"});
