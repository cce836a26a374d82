// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/pattern_images.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.pattern_images", &pattern_images, version{1}, cheap{},
     doc{"The five raw pictures of one frame of a structured-light scanner, under shifted fringes, each at its own "
         "moment: what decode.structured_light turns back into a scan."},
     input{"rig", "Head and its blend shapes"},
     input{"weights", "Blend-shape weights of the frame and its neighbours", window{1, 1}},
     input{"world_from_head", "Where the head is, in the same frames", window{1, 1}},
     input{"camera", "The scanner's camera"}, input{"projector", "The scanner's projector"},
     input{"dots", "Markers, moles and freckles"},
     input{"id", "The frame's id (seq.ids), which gives each frame its own noise"},
     param("width_px", &PatternImagesOptions::width_px, range{1, 4096}, unit{"px"}, "Width of the pictures"),
     param("height_px", &PatternImagesOptions::height_px, range{1, 4096}, unit{"px"}, "Height of the pictures"),
     param("projector_width_px", &PatternImagesOptions::projector_width_px, range{1, 4096}, unit{"px"},
           "Width of the projector's picture"),
     param("projector_height_px", &PatternImagesOptions::projector_height_px, range{1, 4096}, unit{"px"}, "Its height"),
     param("fine_periods", &PatternImagesOptions::fine_periods, range{1, 1024}, unit{"1"},
           "Fringes over the projector's width"),
     param("coarse_periods", &PatternImagesOptions::coarse_periods, range{1, 64}, unit{"1"},
           "Fringes that count the fine ones"),
     param("exposure_step", &PatternImagesOptions::exposure_step, range{0.0, 0.5}, unit{"1"},
           "Frames between two of the five pictures; 0: the head stands still meanwhile"),
     param("exposure", &PatternImagesOptions::exposure, range{0.01, 10.0}, unit{"1"},
           "Grey of a white surface that faces the projector, of 1"),
     param("ambient", &PatternImagesOptions::ambient, range{0.0, 10.0}, unit{"1"},
           "Light beside the projector's, which is 1"),
     param("grey_noise", &PatternImagesOptions::grey_noise, range{0.0, 64.0}, unit{"1"},
           "Standard deviation of the pictures, in steps of 8 bits; 0 switches it off"),
     param("seed", &PatternImagesOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is other noise"),
     output("images", "The five pictures, grey, proportional to light"));
