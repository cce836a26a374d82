// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/even_light.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mask;

NODE("mask.even_light", &even_light, version{1},
     doc{"A scan's picture as even light would show it, by the normals of its depth."}, input{"scan", "Measured depth"},
     param("wild", &EvenLightOptions::wild, range{0.01, 10.0}, unit{"1"},
           "Differences from skin of one colour that count half, share of its light"),
     param("least_light", &EvenLightOptions::least_light, range{0.01, 1.0}, unit{"1"},
           "What is darker than this share of the middle is taken as that"),
     output("scan", "The same with another picture"));
