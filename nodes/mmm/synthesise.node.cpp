// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/synthesise.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.synthesise", &synthesise, version{1}, doc{"The picture of a mouth model at given parameters."},
     input{"model", "From mmm.build"}, input{"parameters", "2 N: alpha, then beta"}, output("image", "The picture"));
