// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/picture.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.picture", &picture, version{1},
     doc{"A picture beside the true one: RMS difference, PSNR, and whether it is as sharp (gradient energy)."},
     input{"picture", "The picture that is judged"}, input{"truth", "The true one"},
     input{"mask", "White where pixels count; without it all do"},
     output("table", "rms_levels, psnr_db, gradient_ratio, pixels"));
