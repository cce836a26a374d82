// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/pick_truth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.pick_truth", &pick_truth, version{1}, doc{"The truth of the frame that was chosen as the reference."},
     input{"truths", "Of all frames of a phantom's stream"}, input{"motions", "Where the head is in each"},
     input{"frame", "From align.choose_reference"},
     output("truth", &PickTruthResult::truth, "Which point of the head every pixel of the frame shows"),
     output("world_from_head", &PickTruthResult::world_from_head, "Where the head is in it"));
