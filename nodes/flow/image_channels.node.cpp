// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/image_channels.h"

#include "engine/node.h"
#include "nodes/types/feature_map.h"
#include "nodes/types/image.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.image_channels", &image_channels, version{1},
     doc{"An image as dense correspondence compares it; a mask leaves pixels out."}, input{"image", "The image"},
     input{"mask", "Dark pixels are left out"}, cheap{},
     param("channels", &ImageChannelsOptions::channels, {{"grey", Channels::grey}, {"colour", Channels::colour}},
           "One channel grey, or red, green and blue"),
     output("channels", "Channels, 0 to 255"));
