// SPDX-License-Identifier: Apache-2.0
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

const Registered flow({
    .inputs = {{"flow.dis.target", another("feature_map", 8)}, {"flow.dis.start", start}},
    .values = {{"flow.dis.channel", {text("radius")}},
               {"flow.farneback.channel", {text("radius")}},
               {"flow.tvl1.channel", {text("radius")}}},
});

}  // namespace
}  // namespace conformance
