// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/decode/structured_light.h"
#include "nodes/types/camera.h"

namespace face::decode {

// The projector of a recorded stream of fringe pictures, and what it projects.
struct ScanProjectorFile {
  Camera projector;
  StructuredLightOptions options;
};

// Reads camera.json's keys of a projector (scan_camera_file.h): fx, cx, cy, width and its pose in the camera's world;
// and "fine_periods", "coarse_periods", "min_amplitude", "near_mm", "far_mm" of StructuredLightOptions, which has what
// is not given. Throws where width is not given, or pixels are not square.
ScanProjectorFile read_scan_projector(const engine::File& file);

}  // namespace face::decode
