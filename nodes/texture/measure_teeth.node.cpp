// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/measure_teeth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.measure_teeth", &measure_teeth, version{1},
     doc{"How much brighter the teeth of a picture are than they are drawn into it."},
     input{"model", "The morphable model of the fit"}, input{"person", "The person of texture.neutralise"},
     input{"albedo", "The face's colours"}, input{"fit", "The fit"}, input{"picture", "The picture"},
     output("gain", "1 x 3, of the sRGB values of red, green and blue; ones where the picture shows no teeth"));
