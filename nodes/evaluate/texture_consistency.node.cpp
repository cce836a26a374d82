// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/texture_consistency.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.texture_consistency", &texture_consistency, version{1},
     doc{"Whether a track holds on to the skin: the reference's texture drawn on every frame, beside that frame."},
     input{"rendered", "The reference's texture where the track says it is"}, input{"frames", "What was seen"},
     input{"masks", "White where the face is drawn; without it everywhere"},
     output("table", &TextureConsistencyResult::table, "RMS difference in 8-bit levels: of all, median, p95, worst"),
     output("frames", &TextureConsistencyResult::frames, "RMS difference per frame"));
