// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "engine/port.h"
#include "nodes/export/gltf_buffer.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::exports {

// The weights of all shapes of the rig, frame by frame: frames x shapes, 0 where a frame's list is shorter. Throws
// where one is longer, or holds what is no finite number.
std::vector<float> weight_rows(const Rig& rig, const engine::Seq<Weights>& frames);

// The weights of one glTF node's morph targets, frames x targets.
struct WeightChannel {
  int node = 0;
  std::vector<float> values;
};

// The animation of these nodes; times and values go into the buffer.
nlohmann::json animation_of(const std::vector<WeightChannel>& channels, const Timeline& timeline, GltfBuffer& buffer);

}  // namespace face::exports
