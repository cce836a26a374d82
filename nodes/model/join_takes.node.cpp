// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/join_takes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.join_takes", &join_takes, version{1},
     doc{"Speech and frames of several takes one after the other, as seq.flatten joins frames."},
     input{"phones", "What is said in every take"}, input{"timelines", "When its frames are shown"},
     output("phones", &JoinTakesResult::phones, "All speech"),
     output("timeline", &JoinTakesResult::timeline, "All frames"));
