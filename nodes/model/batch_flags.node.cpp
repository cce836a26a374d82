// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/batch_flags.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.batch_flags", &batch_flags, version{1},
     doc{"Which scans are in a batch when they are dealt out by how alike they are to the reference."},
     input{"differences", "Of every scan from the reference (model.closest_combination without a space)"},
     param("batch", &BatchFlagsOptions::batch, range{1, 1000}, unit{"1"}, "Which one; 1 is most alike"),
     param("batches", &BatchFlagsOptions::batches, range{1, 1000}, unit{"1"}, "How many there are"),
     output("flags", "True for the scans of the batch"));
