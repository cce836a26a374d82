// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_backdrop.h"

#include "engine/node.h"
#include "nodes/types/image.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.make_backdrop", &make_backdrop, version{1}, doc{"A textured, blurred background for a video."},
     param("width_px", &MakeBackdropOptions::width_px, range{1, 8192}, unit{"px"}, "Width of the picture"),
     param("height_px", &MakeBackdropOptions::height_px, range{1, 8192}, unit{"px"}, "Height of the picture"),
     param("contrast", &MakeBackdropOptions::contrast, range{0.0, 2.0}, unit{"1"}, "Of the texture; 0 is an even grey"),
     param("seed", &MakeBackdropOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed is another wall"),
     output("image", "The background"));
