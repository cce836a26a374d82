// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/merge.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.merge", &merge, version{1}, doc{"One map of a face's colours from those of several pictures."},
     input{"maps", "Maps of texture.extract, of one size"}, output("albedo", "Their mean, by weight"));
