// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/face_mask.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.face_mask", &face_mask, version{1}, doc{"Where a fitted face is in its picture."},
     input{"model", "The morphable model of the fit"}, input{"fit", "The fit"},
     output("mask", "Grey, 255 inside the face's contour"));
