// SPDX-License-Identifier: Apache-2.0
// What nodes are called with: the samples of their ports' types (tests/support/samples.cpp), and what some nodes want
// instead (samples/AREA.cpp).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tests/conformance/node_call.h"
#include "tests/conformance/samples/area_samples.h"

namespace conformance {

// A node's parameters in the samples, and with some of them set otherwise.
Params sample_params(const engine::NodeInfo& info);
Params with_params(const engine::NodeInfo& info, const ParamValues& setting);

std::vector<engine::ParamValue> further_values(const std::string& node, const std::string& param);
std::vector<ParamValues> further_settings(const std::string& node);

// A sample's value. Values travel as void pointers: one of another type than the port's ("node.port") would be read as
// if it were of that type, so it throws.
AnyValue checked_sample(const Sample& sample, const std::string& port, const std::string& type);

// One port's sample; nullopt where its type has none. Variants differ.
std::optional<PortValue> port_sample(engine::Plugins& plugins, const engine::NodeDeclaration& node, std::size_t port,
                                     int variant);

}  // namespace conformance
