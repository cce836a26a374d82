// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/types/morphable_model.h"

namespace face::decode {

struct ReadModelOptions {
  std::int64_t identities = 300;            // of an NPZ's components: the others are expressions
  LengthUnit unit = LengthUnit::automatic;  // of the lengths in the file
};

// Reads a ready-made morphable model: eos's .bin (eos_model.h), an .npz of the SMPL family (flame_model.h), or a GLB or
// glTF file whose morph targets are its components at one standard deviation: those named shape..., identity..., id...
// or beta... the person's, all others expressions. Pickles (.pkl) hold programs and are refused. expressions: a .bin of
// eos's blend shapes, or null. landmarks: a JSON list of the 68 vertices of Multi-PIE's points, or null: without them
// and without points of the file's own only vertex_N names a point. The albedo is empty where the file has no colours
// (model.add_albedo).
MorphableModel read_model(const engine::File& file, const engine::File* expressions, const engine::File* landmarks,
                          const ReadModelOptions& options = {});

}  // namespace face::decode
