// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/mouth_shapes.h"

#include <initializer_list>
#include <string>
#include <utility>

namespace face::model {

void mouth_shapes(const Rig& rig, engine::SeqWriter<Weights>& weights) {
  using Mix = std::initializer_list<std::pair<const char*, float>>;
  const auto push = [&](const std::string& id, Mix mix) {
    Weights result;
    result.values.assign(rig.shapes.size(), 0.0f);
    for (const auto& [name, weight] : mix)
      for (std::size_t s = 0; s < rig.shapes.size(); ++s)
        if (rig.shapes[s].name == name) result.values[s] = weight;
    weights.push(id, std::move(result));
  };
  push("closed", {});
  push("open", {{"jawOpen", 0.5f}});
  push("round", {{"jawOpen", 0.15f}, {"mouthPucker", 0.8f}});
  push("wide", {{"jawOpen", 0.2f}, {"mouthStretchLeft", 0.5f}, {"mouthStretchRight", 0.5f}});
  push("smile", {{"jawOpen", 0.1f}, {"mouthSmileLeft", 0.6f}, {"mouthSmileRight", 0.6f}});
}

}  // namespace face::model
