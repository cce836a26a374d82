// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/reanimate.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.reanimate", &reanimate, version{3},
     doc{"Puts a face back into the frames of its video with another mouth, blurred by its motion."},
     input{"model", "The morphable model of the fits"}, input{"person", "The person of texture.neutralise"},
     input{"albedo", "The face's colours"}, input{"fit", "The fit of each frame"}, input{"frame", "The video's frames"},
     input{"background", "What is behind the face in each frame"},
     input{"weights", "Weights of the person's shapes in each frame", window{0, 1}},
     input{"teeth", "Gain of texture.measure_teeth; without it teeth are as bright as the skin"},
     param("samples", &ReanimateOptions::samples, range{1, 4}, unit{"1"}, "Samples per pixel and axis"),
     param("moments", &ReanimateOptions::moments, range{1, 16}, unit{"1"},
           "Mouths drawn between a frame and the next, for motion blur"),
     output("image", "The frame with the new mouth"));
