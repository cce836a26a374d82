// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::transfer {

struct MorphOptions {
  double begin = 0.25;
  double end = 0.75;
};

// A speaking face that turns into another while it speaks (Bargmann, Blanz and Seidel, sections 6 and 7): frame by
// frame the pose of both, points and colours mixed, the first alone up to the share `begin` of the frames, the second
// alone from `end`, smoothly between. from, to: rigs of one topology (of transfer.move_model's models); where one has
// colours the other has too. Every frame is a head whose neutral is that of `from`, so that a camera that looks at the
// neutral stands still, with one shape: the mixed pose, at the weight 1 that poses says.
void morph(const Rig& from, const Rig& to, const engine::Seq<Weights>& weights, engine::SeqWriter<Rig>& heads,
           engine::SeqWriter<Weights>& poses, const MorphOptions& options = {});

}  // namespace face::transfer
