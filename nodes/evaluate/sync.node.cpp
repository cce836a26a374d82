// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/sync.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;

NODE("evaluate.sync", &face::evaluate::sync, version{1},
     doc{"Sound and movement: when each of them begins, and how far apart that is."}, input{"audio", "What is heard"},
     input{"weights", "The animation to it"}, input{"timeline", "When every frame is shown"},
     param("loud_db", &face::evaluate::SyncOptions::loud_db, range{-100, -1}, unit{"dB"},
           "Sound begins where it is so far below its loudest"),
     param("moved", &face::evaluate::SyncOptions::moved, range{0.0001, 1}, unit{"1"},
           "Change of a weight of the mouth that counts as movement"),
     output("table", "audio_onset_s, first_move_s, late_ms, sync_ms"));
