// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"

namespace face::model {

struct BatchFlagsOptions {
  std::int64_t batch = 1;
  std::int64_t batches = 3;
};

// Which scans are in a batch when they are dealt out by how alike they are to the reference (Blanz, Basso, Poggio,
// Vetter: Reanimating Faces in Images and Video, 2003, section 2.3, which does it by eye: 11 of 35 in the first of
// three batches): sorted by difference, the first n / batches are batch 1, and so on. differences: of
// closest_combination without a space. flags: one per scan, by its id, true where it is in the batch.
void batch_flags(const engine::Seq<double>& differences, engine::SeqWriter<bool>& flags,
                 const BatchFlagsOptions& options = {});

}  // namespace face::model
