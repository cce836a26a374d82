// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_model.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.model", &read_model, version{1},
     doc{"Reads a ready-made morphable model: a .bin of eos (Surrey Face Model), an .npz like FLAME's, or a GLB."},
     input{"file", "The model"}, input{"expressions", "Blend shapes of eos for a .bin that has no expressions"},
     input{"landmarks", "JSON list of the 68 vertices of Multi-PIE's points"},
     param("identities", &ReadModelOptions::identities, range{0, 100000}, unit{"1"},
           "How many of an .npz's first components are the person's; the others are expressions"),
     param("unit", &ReadModelOptions::unit,
           {{"automatic", LengthUnit::automatic}, {"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}},
           "Unit of the lengths in the file; automatic goes by the size of the head"),
     output("model", "The model, in mm"));
