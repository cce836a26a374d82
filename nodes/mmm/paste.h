// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::mmm {

struct PasteOptions {
  int left_px = 0;
  int top_px = 0;
  double feather_px = 12;
  int head_frames = 60;
};

// A head with another mouth: `mouth` takes the place of what is at left_px, top_px; over feather_px from its edge it
// goes over into the head. Where the mouth's edge is the picture's edge there is no feather. Throws where the mouth
// does not lie within the head.
Image paste_mouth(const Image& head, const Image& mouth, const PasteOptions& options = {});

// The same for every mouth of a sentence. heads: a normalised video, whose eyes and brows move; of its first
// head_frames (they are held in memory) the first to the last are taken, then back to the first, and so on, so that
// nothing jumps. landmarks: the mouths are the lower face (face_boxes.h) and go there, in place of left_px and top_px;
// may be null.
void paste(const engine::Seq<Image>& heads, const engine::Seq<Image>& mouths, const Landmarks* landmarks,
           engine::SeqWriter<Image>& frames, const PasteOptions& options = {});

}  // namespace face::mmm
