// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/table.h"

namespace face::cluster {

struct KeyShapeSheetOptions {
  std::int64_t columns = 4;
  std::int64_t picture_px = 240;  // width and height of one picture
};

// What an artist has to sculpt: the part of every key shape's frame around its landmarks, with the landmarks on it, the
// frame's id and the size of its group; and, where a curve from merge() is given, a last picture of the reconstruction
// error (red) and of the cost of merging (blue) over the number of groups, each as a share of its largest, with a line
// at the number of key shapes (Animating Lip-Sync Speech Faces, Fig. 7). tracks: the landmarks as they lie in the
// frames, by the frames' ids, where the key shapes' own are those of a head that was held still; null = these.
Image key_shape_sheet(const KeyShapes& key_shapes, const engine::Seq<Image>& frames,
                      const engine::Seq<Landmarks>* tracks, const Table* curve,
                      const KeyShapeSheetOptions& options = {});

}  // namespace face::cluster
