// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/scan_frame.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE(
    "phantom.scan_frame", &scan_frame, version{1},
    doc{"One frame of a structured-light scanner with a camera and a projector beside it: shadow holes, grazing noise, "
        "dropouts, steps, motion during its five pictures; every fault can be switched off. With the truth."},
    input{"rig", "Head and its blend shapes"},
    input{"weights", "Blend-shape weights of the frame and its neighbours", window{1, 1}},
    input{"world_from_head", "Where the head is, in the same frames", window{1, 1}},
    input{"camera", "The scanner's camera"}, input{"projector", "The scanner's projector"},
    input{"dots", "Markers, moles and freckles"},
    input{"lost", "Vertices that the scanner has lost for good (phantom.lose_points); unconnected: none"},
    input{"id", "The frame's id (seq.ids), which gives each frame its own noise"},
    param("width_px", &ScanFrameOptions::width_px, range{1, 4096}, unit{"px"}, "Width of the scan"),
    param("height_px", &ScanFrameOptions::height_px, range{1, 4096}, unit{"px"}, "Height of the scan"),
    param("projector_width_px", &ScanFrameOptions::projector_width_px, range{1, 4096}, unit{"px"},
          "Width of the projector's picture; there is no light beside it"),
    param("projector_height_px", &ScanFrameOptions::projector_height_px, range{1, 4096}, unit{"px"}, "Its height"),
    param("shadow_holes", &ScanFrameOptions::shadow_holes,
          "Off: what the projector does not light is measured nevertheless"),
    param("noise_mm", &ScanFrameOptions::noise_mm, range{0.0, 100.0}, unit{"mm"},
          "Standard deviation of depth on a surface that faces the scanner; 0 switches it off"),
    param("grazing", &ScanFrameOptions::grazing, range{0.0, 10.0}, unit{"1"},
          "How much noise grows with the angle, times 1 / cosine - 1; 0 switches it off"),
    param("max_angle_deg", &ScanFrameOptions::max_angle_deg, range{1.0, 90.0}, unit{"deg"},
          "Steeper surfaces are not measured; 90 switches it off"),
    param("min_signal", &ScanFrameOptions::min_signal, range{0.0, 1.0}, unit{"1"},
          "Darker surfaces (albedo times cosine) are not measured; 0 switches it off"),
    param("dropouts", &ScanFrameOptions::dropouts, range{0.0, 1.0}, unit{"1"},
          "Share of the pixels that are lost without a reason; 0 switches it off"),
    param("depth_step_mm", &ScanFrameOptions::depth_step_mm, range{0.0, 100.0}, unit{"mm"},
          "Depth comes in multiples of it; 0 switches it off"),
    param("exposure_step", &ScanFrameOptions::exposure_step, range{0.0, 0.5}, unit{"1"},
          "Frames between two of the five pictures; 0: the head stands still meanwhile"),
    param("ripple", &ScanFrameOptions::ripple, range{0.0, 10.0}, unit{"1"},
          "Error of a moving phase, in depths moved between two pictures; 0 switches it off"),
    param("ripple_period_px", &ScanFrameOptions::ripple_period_px, range{1.0, 4096.0}, unit{"px"},
          "Period of the fringes in the projector"),
    param("max_motion_mm", &ScanFrameOptions::max_motion_mm, range{0.0, 1000.0}, unit{"mm"},
          "A pixel whose depth changes more during the five pictures is lost"),
    param("ambient", &ScanFrameOptions::ambient, range{0.0, 10.0}, unit{"1"},
          "Light beside the projector's, which is 1"),
    param("light", &ScanFrameOptions::light, "Off: the picture shows the surface's own grey, without light and shade"),
    param("grey_noise", &ScanFrameOptions::grey_noise, range{0.0, 64.0}, unit{"1"},
          "Standard deviation of the picture, in steps of 8 bits; 0 switches it off"),
    param("seed", &ScanFrameOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is other noise"),
    output("scan", &ScanFrameResult::scan, "Depth and grey picture"),
    output("truth", &ScanFrameResult::truth, "Which point of the head every pixel shows"));
