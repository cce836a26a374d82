// SPDX-License-Identifier: Apache-2.0
// What nodes are called with: the samples of their ports' types, and what a few nodes want instead.
#pragma once
#include <map>
#include <optional>
#include <string>

#include "engine/plugin/plugins.h"
#include "tests/conformance/node_call.h"

namespace conformance {

// Nodes that are not called, with the reason. A new node is not added here: it gets samples.
const std::map<std::string, std::string>& nodes_without_sample();

// Parameters and inputs, as "node.name", that count only where the samples do not lead, with the reason. The suite
// fails when one of them does count: then it goes from here.
const std::map<std::string, std::string>& shown_elsewhere();

// Parameters that samples need set, as they are too small, or too large, for the defaults.
Params sample_params(const engine::NodeInfo& info);

// Further values to try for a parameter of type text (an integer for a number), beside the usual ones.
std::vector<engine::ParamValue> further_values(const std::string& node, const std::string& param);

// One port's sample; nullopt where its type has none. Variants differ.
std::optional<PortValue> port_sample(engine::Plugins& plugins, const engine::NodeDeclaration& node, std::size_t port,
                                     int variant);

}  // namespace conformance
