// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/run.h"

namespace engine {

// One value of an output: of a mapped node, or in a sequence.
struct StoredLeaf {
  std::string element;  // "", "17", "take03/17"
  Digest identity;      // equal values have equal ones, but those of cheap nodes: equal identities mean equal values
};

struct StoredOutput {
  std::vector<StoredLeaf> leaves;  // those that are there, in order
  bool complete = false;           // no other is missing
  bool cheap = false;              // its values are not kept
};

// What the store has of a node of a graph.
struct StoredNode {
  std::size_t tasks = 0, stored = 0;  // tasks known of, and those with a result
  double seconds = 0;                 // that they took when they were run
  std::vector<std::string> warnings;  // "17: text", in the order of the elements
  std::vector<StoredOutput> outputs;
};

// Looks at a graph's results without running anything; as GraphNode, by index.
std::vector<StoredNode> inspect_graph(const Graph& graph, Plugins& plugins, Store& store);

// A value of a type ("mesh", "file") from the store; nothing where the store does not have it.
std::optional<Value> stored_value(const std::string& type, const Digest& identity, Plugins& plugins, Store& store);
// Bytes that it takes outside the store: its canonical form, or the file. -1 where the store does not have it.
std::int64_t stored_bytes(const std::string& type, const Digest& identity, Store& store);

}  // namespace engine
