// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/gltf_animation.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "nodes/base/check.h"

namespace face::exports {

std::vector<float> weight_rows(const Rig& rig, const engine::Seq<Weights>& frames) {
  std::vector<float> values;
  values.reserve(frames.size() * rig.shapes.size());
  std::size_t index = 0;
  for (const Weights& weights : frames) {
    check(weights.values.size() <= rig.shapes.size(), "frame ", frames.id(index), " has ", weights.values.size(),
          " weights, but the rig has ", rig.shapes.size(), " shapes");
    values.insert(values.end(), weights.values.begin(), weights.values.end());
    values.resize(++index * rig.shapes.size(), 0.0f);
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    check(std::isfinite(values[i]), "weight ", rig.shapes[i % rig.shapes.size()].name, " of frame ",
          frames.id(i / rig.shapes.size()), " is not a finite number");
  return values;
}

nlohmann::json animation_of(const std::vector<WeightChannel>& channels, const Timeline& timeline, GltfBuffer& buffer) {
  std::vector<float> times;
  times.reserve(timeline.time_s.size());
  for (const double time_s : timeline.time_s) times.push_back(static_cast<float>(time_s));
  const int input = buffer.add_scalars(times, true);
  nlohmann::json targets = nlohmann::json::array(), samplers = nlohmann::json::array();
  for (const WeightChannel& channel : channels) {
    targets.push_back({{"sampler", samplers.size()}, {"target", {{"node", channel.node}, {"path", "weights"}}}});
    const int output = buffer.add_scalars(channel.values, false);
    samplers.push_back({{"input", input}, {"interpolation", "LINEAR"}, {"output", output}});
  }
  return {{"name", "performance"}, {"channels", std::move(targets)}, {"samplers", std::move(samplers)}};
}

}  // namespace face::exports
