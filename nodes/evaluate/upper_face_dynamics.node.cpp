// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/upper_face_dynamics.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.upper_face_dynamics", &upper_face_dynamics, version{1},
     doc{"Upper-face dynamics deviation (FDD): whether lids, brows and forehead move as much as in the truth; positive "
         "where they move less."},
     input{"rig", "The head that both animate"}, input{"weights", "The animation that is judged"},
     input{"truth", "The true weights, frame by frame"},
     input{"upper_face", "Which vertices count; without it the skin from the lower lids upwards"},
     output("table", "fdd_mm2, and the two means that it is the difference of"));
