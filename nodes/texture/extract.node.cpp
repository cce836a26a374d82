// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/extract.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.extract", &extract, version{3},
     doc{"Reads a face's own colours off a picture, its light undone; what is not seen is the model's, tinted alike."},
     input{"model", "The morphable model of the fit"}, input{"picture", "The picture that was fitted"},
     input{"fit", "The fit"},
     param("size_px", &ExtractOptions::size_px, range{64, 8192}, unit{"px"}, "Sides of the map"),
     output("albedo", "The face's colours over the mesh's uvs"));
