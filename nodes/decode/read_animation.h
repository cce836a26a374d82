// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::decode {

struct ReadAnimationOptions {
  double timecode_rate_hz = 60;  // frames per second of the timecodes of a Live Link file, which does not say it
};

struct ReadAnimationResult {
  engine::Seq<Weights> weights;  // of every frame, in the order of the shapes that decode.rig gives
  Timeline timeline;
};

// Reads blend-shape weights over time: the first animation of a GLB or glTF file (its keys are the frames; where meshes
// have keys at other times they are interpolated linearly), or a table with the columns of Live Link Face (Timecode,
// BlendShapeCount, EyeBlinkLeft, ...; angles of head and eyes are left out). Names are told as in read_rig; of several
// targets with one name the first counts. names: as in read_rig, or null. Throws where there is no animation of
// weights, and where times do not ascend.
ReadAnimationResult read_animation(const engine::File& file, const engine::File* names,
                                   const ReadAnimationOptions& options = {});

}  // namespace face::decode
