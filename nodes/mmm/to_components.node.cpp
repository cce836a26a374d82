// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/to_components.h"

#include "engine/node.h"
#include "nodes/types/matrix.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.to_components", &to_components, version{1}, doc{"A frame's mouth parameters as a few uncorrelated numbers."},
     input{"components", "From mmm.find_components"}, input{"parameters", "2 N: alpha, then beta"},
     output("numbers", "As many as there are components"));
