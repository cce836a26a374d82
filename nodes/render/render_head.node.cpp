// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/render_head.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

using namespace engine::declare;
using namespace face::render;

NODE("render.render_head", &render_head, version{1},
     doc{"Picture of a head at given blend-shape weights, lit softly from the front."},
     input{"rig", "Head and its blend shapes"}, input{"weights", "Blend-shape weights of the frame"},
     param("width_px", &RenderHeadOptions::width_px, range{16, 4096}, unit{"px"}, "Width of the picture"),
     param("height_px", &RenderHeadOptions::height_px, range{16, 4096}, unit{"px"}, "Height of the picture"),
     param("yaw_deg", &RenderHeadOptions::yaw_deg, range{-180.0, 180.0}, unit{"deg"},
           "Camera's place about the head; positive shows the head's left side"),
     param("pitch_deg", &RenderHeadOptions::pitch_deg, range{-89.0, 89.0}, unit{"deg"},
           "Camera's height; positive looks down from above"),
     param("distance_mm", &RenderHeadOptions::distance_mm, range{0.0, 10000.0}, unit{"mm"},
           "Distance from the middle of what is framed; 0 fills the picture with it"),
     param("framing", &RenderHeadOptions::framing, {{"head", Framing::head}, {"face", Framing::face}},
           "What stands in the middle of the picture: the head, or the face from brows to chin"),
     param("field_of_view_deg", &RenderHeadOptions::field_of_view_deg, range{1.0, 120.0}, unit{"deg"},
           "Vertical field of view"),
     param("samples", &RenderHeadOptions::samples, range{1, 4}, unit{"1"}, "Samples per pixel and axis"),
     param("background_red", &RenderHeadOptions::background_red, range{0.0, 1.0}, unit{"1"},
           "Red of the background, sRGB"),
     param("background_green", &RenderHeadOptions::background_green, range{0.0, 1.0}, unit{"1"},
           "Green of the background, sRGB"),
     param("background_blue", &RenderHeadOptions::background_blue, range{0.0, 1.0}, unit{"1"},
           "Blue of the background, sRGB"),
     output("image", "The picture"));
