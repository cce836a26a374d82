// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/image.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Image, "image", codec_version{1}, doc{"An 8-bit sRGB image."}, field<&Image::width>(), field<&Image::height>(),
     field<&Image::channels>(), field<&Image::pixels>(), view{"png", "export.png"},
     difference{"evaluate.image_difference"});
