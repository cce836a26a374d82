// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::render {

struct RenderSheetOptions {
  int pictures = 24;
  int columns = 6;
  int picture_px = 240;  // width and height of one
  double yaw_deg = 10;   // slightly from the side: lips that protrude are seen
};

// A contact sheet of an animation: the face in key frames (pick_key_frames) with the phone, its word and its time under
// each.
Image render_sheet(const Rig& rig, const engine::Seq<Weights>& weights, const Timeline& timeline, const Phones& phones,
                   const RenderSheetOptions& options = {});

}  // namespace face::render
