// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct TextureConsistencyResult {
  Table table;   // row "all": rms_levels (over all pixels of all frames), median_levels, p95_levels, worst_levels
  Table frames;  // per frame: rms_levels
};

// Whether a track holds on to the skin: the texture of the reference frame, drawn on every frame where the track says
// it is, looks like that frame. rendered: those drawings; frames: what was seen; masks: white where the drawing shows
// the face, null = everywhere. Differences as in picture(). A frame whose mask is empty has no value.
TextureConsistencyResult texture_consistency(const engine::Seq<Image>& rendered, const engine::Seq<Image>& frames,
                                             const engine::Seq<Image>* masks);

}  // namespace face::evaluate
