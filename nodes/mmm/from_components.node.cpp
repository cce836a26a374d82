// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/from_components.h"

#include "engine/node.h"
#include "nodes/types/matrix.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.from_components", &from_components, version{1}, doc{"The mouth parameters of a frame from a few numbers."},
     input{"components", "From mmm.find_components"}, input{"numbers", "As many as there are components"},
     output("parameters", "2 N: alpha, then beta"));
