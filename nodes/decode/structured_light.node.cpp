// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/structured_light.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.structured_light", &structured_light, version{1},
     doc{"Turns the five fringe pictures of a structured-light scanner and its calibration into a scan."},
     input{"images", "Five pictures: coarse cosine, three fine fringes, coarse sine; grey, proportional to light"},
     input{"camera", "The calibrated camera"}, input{"projector", "The calibrated projector, in the same world"},
     param("projector_width_px", &StructuredLightOptions::projector_width_px, range{1, 4096}, unit{"px"},
           "Width of the projector's picture"),
     param("fine_periods", &StructuredLightOptions::fine_periods, range{1, 1024}, unit{"1"},
           "Fringes over the projector's width"),
     param("coarse_periods", &StructuredLightOptions::coarse_periods, range{1, 64}, unit{"1"},
           "Fringes that count the fine ones"),
     param("near_mm", &StructuredLightOptions::near_mm, range{0.0, 100000.0}, unit{"mm"}, "Least depth that can be"),
     param("far_mm", &StructuredLightOptions::far_mm, range{0.0, 100000.0}, unit{"mm"}, "Largest depth that can be"),
     param("min_amplitude", &StructuredLightOptions::min_amplitude, range{0.0, 128.0}, unit{"1"},
           "Weaker fringes, in steps of 8 bits, are shadow or background"),
     param("max_mismatch", &StructuredLightOptions::max_mismatch, range{0.0, 0.5}, unit{"1"},
           "Larger differences of coarse and fine fringes, in fine periods, are motion or edges"),
     output("scan", "Depth and grey picture"));
