// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::model {

// The frames of a clip on which points were placed, for model.fit_images: those whose ids the landmarks have, in the
// landmarks' order. Throws where the clip has no such frame.
void pick_frames(const engine::Seq<Image>& frames, const engine::Seq<Landmarks>& landmarks,
                 engine::SeqWriter<Image>& picked);

}  // namespace face::model
