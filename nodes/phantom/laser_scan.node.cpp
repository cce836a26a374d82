// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/laser_scan.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE(
    "phantom.laser_scan", &laser_scan, version{1},
    doc{"A cylindrical laser scan of a head: r(h, phi) and RGB, with noise, missing hair and missing steep places, and "
        "the truth."},
    input{"rig", "Head and its blend shapes"}, input{"weights", "Blend-shape weights of the face that it makes"},
    input{"dots", "Spots on the skin"}, input{"id", "The scan's id (seq.ids), which gives each its own noise"},
    param("rows", &LaserScanOptions::rows, range{1, 4096}, unit{"1"}, "Steps in height"),
    param("columns", &LaserScanOptions::columns, range{8, 8192}, unit{"1"}, "Steps of the full turn"),
    param("top_mm", &LaserScanOptions::top_mm, range{-10000.0, 10000.0}, unit{"mm"}, "Height of the first row"),
    param("step_mm", &LaserScanOptions::step_mm, range{0.01, 100.0}, unit{"mm"}, "From row to row"),
    param("axis_x_mm", &LaserScanOptions::axis_x_mm, range{-1000.0, 1000.0}, unit{"mm"}, "Place of the vertical axis"),
    param("axis_z_mm", &LaserScanOptions::axis_z_mm, range{-1000.0, 1000.0}, unit{"mm"}, "Place of the vertical axis"),
    param("bathing_cap", &LaserScanOptions::bathing_cap, "No hair, and a cap over the skull"),
    param("missing_hair", &LaserScanOptions::missing_hair, range{0.0, 1.0}, unit{"1"},
          "Share of the hair that the laser does not see; 0 switches it off"),
    param("max_angle_deg", &LaserScanOptions::max_angle_deg, range{1.0, 90.0}, unit{"deg"},
          "Places steeper towards the laser, as below the chin, are missing; 90 switches it off"),
    param("dropouts", &LaserScanOptions::dropouts, range{0.0, 1.0}, unit{"1"},
          "Share of the pixels that are lost without a reason; 0 switches it off"),
    param("noise_mm", &LaserScanOptions::noise_mm, range{0.0, 100.0}, unit{"mm"},
          "Standard deviation of the radius; 0 switches it off"),
    param("radius_step_mm", &LaserScanOptions::radius_step_mm, range{0.0, 100.0}, unit{"mm"},
          "The radius comes in multiples of it; 0 switches it off"),
    param("shading", &LaserScanOptions::shading, range{0.0, 1.0}, unit{"1"},
          "How much the colour darkens with the angle to the lamp; 0: pure albedo"),
    param("colour_noise", &LaserScanOptions::colour_noise, range{0.0, 64.0}, unit{"1"},
          "Standard deviation of the colours, in steps of 8 bits; 0 switches it off"),
    param("seed", &LaserScanOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is other noise"),
    output("scan", &LaserScanResult::scan, "Radius and colour over height and angle"),
    output("truth", &LaserScanResult::truth, "Which point of the head every pixel shows"));
