// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"

namespace face::render {

// A frame that shows a phone at its best.
struct KeyFrame {
  std::size_t frame = 0;  // index in the timeline
  std::size_t phone = 0;  // index in Phones::phones
};

// At most `count` frames that tell what a mouth does: the middles of lip closures and lip-teeth contacts, of vowels,
// and of other long phones; a label that was picked already counts less, so that the choice is varied. In order of
// time, no frame twice. Silence only where there is nothing else.
std::vector<KeyFrame> pick_key_frames(const Phones& phones, const Timeline& timeline, std::size_t count);

}  // namespace face::render
