// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/synthesise.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.synthesise", &synthesise, version{2}, doc{"The picture of a mouth model at given parameters."},
     input{"model", "From mmm.build"}, input{"parameters", "2 N: alpha, then beta"},
     param("most_gain", &SynthesiseOptions::most_gain, range{1.0, 10.0}, unit{"1"},
           "Of detail that the mean of prototypes has lost; 1 = the mean as it is"),
     output("image", "The picture"));
