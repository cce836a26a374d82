// SPDX-License-Identifier: Apache-2.0
// The rules that every node keeps. A broken one is a line: "node: port or parameter: rule: what was found".
#pragma once
#include <string>
#include <vector>

#include "engine/plugin/plugins.h"

namespace conformance {

using Lines = std::vector<std::string>;

// Of its declaration alone. plugin: that it is in.
Lines broken_by_declaration(const engine::NodeInfo& node, const std::string& plugin);

// Of what it does with its samples: same result twice and with any number of threads, inputs left alone, every
// parameter and every input counts.
Lines broken_by_behaviour(engine::Plugins& plugins, const std::string& node);

// Of empty, one-element and non-finite input: each one by one, in a process of its own (this program, started again
// with the given filter), since a node may take the process with it.
Lines broken_by_odd_input(const std::string& filter);
// The other side of it: prints what it tries; called in that process.
bool asked_for_odd_input();
void try_odd_input(engine::Plugins& plugins, const std::string& node);

}  // namespace conformance
