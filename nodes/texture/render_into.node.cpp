// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/render_into.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.render_into", &render_into, version{3},
     doc{"Puts a face back into its picture with another mouth, under the light that was found."},
     input{"model", "The morphable model of the fit"}, input{"person", "The person of texture.neutralise"},
     input{"albedo", "The face's colours"}, input{"fit", "The fit"}, input{"picture", "The picture"},
     input{"background", "What shows where the face was; without it the picture"},
     input{"weights", "Weights of the person's shapes; without them the fit's own expression"},
     input{"teeth", "Gain of texture.measure_teeth; without it teeth are as bright as the skin"},
     param("samples", &RenderIntoOptions::samples, range{1, 4}, unit{"1"}, "Samples per pixel and axis"),
     output("image", "The picture with the new face"));
