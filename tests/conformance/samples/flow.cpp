// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

// A target so far away that a start helps, and such a start.
const Maker start = made([](int variant) {
  face::FlowField flow{64, 48, {}, {}};
  flow.displacement_px.assign(64 * 48, {5.6f - 0.4f * static_cast<float>(variant), -3.2f});
  flow.valid.assign(64 * 48, 1);
  return flow;
});

// Grey that shows an eye, and the same with the skin above it drawn down over it: pixels are lost.
Maker eye(bool open) {
  return changed<face::FeatureMap>(another("feature_map", 0), [open](face::FeatureMap& map, int) {
    float* grey = map.values.data();  // the first channel
    const std::vector<float> skin(grey, grey + map.valid.size());
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * map.width + x); };
    for (int y = 8; y < 32; ++y)
      for (int x = 18; x < 46; ++x) {
        if (open && y >= 20) grey[at(x, y)] = x < 32 ? 255.0f : 0.0f;
        if (!open) grey[at(x, y)] = skin[at(x, 8 + (y - 8) / 2)];
      }
  });
}

const Registered flow({
    .inputs = {{"flow.scan.reference", eye(true)},
               {"flow.scan.target", eye(false)},
               {"flow.dis.target", another("feature_map", 8)},
               {"flow.dis.start", start}},
    .values = {{"flow.scan.mismatch", {2.0, 4.0}},
               {"flow.dis.channel", {text("radius")}},
               {"flow.farneback.channel", {text("radius")}},
               {"flow.tvl1.channel", {text("radius")}}},
});

}  // namespace
}  // namespace conformance
