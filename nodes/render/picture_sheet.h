// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"

namespace face::render {

struct PictureSheetOptions {
  int columns = 6;
  bool captions = true;  // every picture's id under it
};

// Pictures in rows from the top left, for people who look. All have one size; at least one.
Image picture_sheet(const engine::Seq<Image>& images, const PictureSheetOptions& options = {});

}  // namespace face::render
