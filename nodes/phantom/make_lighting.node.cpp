// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_lighting.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.make_lighting", &make_lighting, version{1},
     doc{"One parallel and one ambient light, and what the camera makes of colours: contrast, gain, offset."},
     param("yaw_deg", &MakeLightingOptions::yaw_deg, range{-180.0, 180.0}, unit{"deg"},
           "Where the parallel light comes from; positive: from the head's left"),
     param("pitch_deg", &MakeLightingOptions::pitch_deg, range{-90.0, 90.0}, unit{"deg"}, "Positive: from above"),
     param("parallel_red", &MakeLightingOptions::parallel_red, range{0.0, 4.0}, unit{"1"}, "Parallel light, red"),
     param("parallel_green", &MakeLightingOptions::parallel_green, range{0.0, 4.0}, unit{"1"}, "Parallel light, green"),
     param("parallel_blue", &MakeLightingOptions::parallel_blue, range{0.0, 4.0}, unit{"1"}, "Parallel light, blue"),
     param("ambient_red", &MakeLightingOptions::ambient_red, range{0.0, 4.0}, unit{"1"}, "Ambient light, red"),
     param("ambient_green", &MakeLightingOptions::ambient_green, range{0.0, 4.0}, unit{"1"}, "Ambient light, green"),
     param("ambient_blue", &MakeLightingOptions::ambient_blue, range{0.0, 4.0}, unit{"1"}, "Ambient light, blue"),
     param("contrast", &MakeLightingOptions::contrast, range{0.0, 2.0}, unit{"1"}, "Of colours: 1 as they are, 0 grey"),
     param("gain_red", &MakeLightingOptions::gain_red, range{0.0, 4.0}, unit{"1"}, "Gain of the red channel"),
     param("gain_green", &MakeLightingOptions::gain_green, range{0.0, 4.0}, unit{"1"}, "Gain of the green channel"),
     param("gain_blue", &MakeLightingOptions::gain_blue, range{0.0, 4.0}, unit{"1"}, "Gain of the blue channel"),
     param("offset_red", &MakeLightingOptions::offset_red, range{-1.0, 1.0}, unit{"1"}, "Added to red; 1 is white"),
     param("offset_green", &MakeLightingOptions::offset_green, range{-1.0, 1.0}, unit{"1"}, "Added to green"),
     param("offset_blue", &MakeLightingOptions::offset_blue, range{-1.0, 1.0}, unit{"1"}, "Added to blue"),
     output("lighting", "The light"));
