// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/draw_fit.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.draw_fit", &draw_fit, version{1}, doc{"Draws a fitted face over its picture, in grey."},
     input{"model", "The morphable model of the fit"}, input{"fit", "The fit"}, input{"picture", "The picture"},
     param("opacity", &DrawFitOptions::opacity, range{0, 1}, unit{"1"}, "Of the drawn face"),
     output("image", "The picture with the face"));
