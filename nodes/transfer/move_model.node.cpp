// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/move_model.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.move_model", &move_model, version{2}, doc{"A speaking model on another face."},
     input{"model", "The speaking model"}, input{"from", "Its neutral face"},
     input{"to", "The new neutral face, from transfer.resample"},
     output("moved", "The model with the new face's mean and the same displacements"));
