// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/surface_map.h"

namespace face::transfer {

struct PickTruthResult {
  SurfaceMap truth;
  RigidMotion world_from_head;
};

// The truth of the frame that align.choose_reference chose, by its id. truths, motions: of all frames of a phantom's
// stream (flattened as the scans are). Throws where no frame has the id.
PickTruthResult pick_truth(const engine::Seq<SurfaceMap>& truths, const engine::Seq<RigidMotion>& motions,
                           const std::string& frame);

}  // namespace face::transfer
