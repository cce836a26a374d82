// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/export/export_depth.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.scan_camera", &export_scan_camera, version{1},
     doc{"Writes the camera.json of a recorded stream of scans: intrinsics, pose, unit of depth and rate."},
     input{"camera", "The scanner's camera"},
     param("width_px", &ExportScanCameraOptions::width_px, range{1, 65536}, unit{"px"}, "Width of its pictures"),
     param("height_px", &ExportScanCameraOptions::height_px, range{1, 65536}, unit{"px"}, "Height of its pictures"),
     param("depth_unit_mm", &ExportScanCameraOptions::depth_unit_mm, range{0.0001, 1000.0}, unit{"mm"},
           "As in export.depth"),
     param("rate_hz", &ExportScanCameraOptions::rate_hz, range{0.01, 10000.0}, unit{"Hz"}, "Frames per second"),
     output("file", "The .json file"));
