// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/build.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.build", &build, version{2},
     doc{"A multidimensional morphable model of a mouth: typical pictures and the flows from one of them to each."},
     input{"images", "Normalised pictures of the mouth"},
     input{"exemplars", "K x 1: numbers of the typical ones, from a clustering"}, output("model", "The model"));
