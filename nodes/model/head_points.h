// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/morphable_model.h"

namespace face::model {

// How a scanned head's teeth and inner mouth follow its skin (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images
// and Video, 2003, section 2.4). The upper teeth stay where they are in the skull, the lower ones keep their offset to
// the tip of the chin, and the walls of the mouth hang on the lips and reach back to a throat that stays.
// skin_mm: S x 3. Returns V x 3; the skin itself where the surface has nothing else.
std::vector<Vec3f> head_points(const MorphableModel& surface, const std::vector<Vec3f>& skin_mm);

// How every vertex beyond the skin follows it.
struct Follower {
  std::uint32_t skin = 0;  // vertex whose displacement it takes
  float share = 0;         // of it: 0 = stays
};
std::vector<Follower> followers(const MorphableModel& surface);

}  // namespace face::model
