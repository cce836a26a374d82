// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/problem.h"
#include "engine/declare/node_info.h"

namespace engine {

// What an input port or a graph output is connected to.
struct Source {
  enum class Kind { none, node, file };  // none = unconnected (an optional input, or a parameter that is unset)
  Kind kind = Kind::none;
  int node = -1;                     // index in Graph::nodes
  int output = 0;                    // index in the node's outputs
  std::vector<std::string> element;  // node[take03/17]: one id per level, outermost first
  std::string path;                  // Kind::file: absolute, normalised
  std::string shown_path;            // seen from the folder that the graph file is named from, for messages
  Place place;
};

// Parameters that differ for some elements of a mapped node.
struct Override {
  struct Range {
    std::vector<std::string> parents;  // ids of outer levels ("take03/17"); empty = under every parent
    std::string first, last;           // equal for a single id; last is an integer where they differ
  };
  std::string text;  // "17-23,40", for messages
  std::vector<Range> ranges;
  std::vector<std::pair<int, ParamValue>> params;  // index in NodeInfo::params
  Place place;
};

struct GraphNode {
  std::string id;  // "flow", or "stabilise/flow" inside a subgraph
  const NodeInfo* info = nullptr;
  std::vector<std::vector<Source>> inputs;  // per port; one source, none when unconnected, several at a variadic port
  std::vector<ParamValue> params;           // as NodeInfo::params, all filled in
  std::vector<Override> overrides;
  int mapped_depth = 0;                  // levels over which the node is mapped
  std::vector<int> input_depth;          // per port: depth of what is connected, after its element selection
  std::vector<int> output_depth;         // per output: mapped_depth + OutputInfo::depth
  std::vector<std::string> output_type;  // per output
  bool needed = false;                   // some output of the graph depends on it
  Place place;
};

struct GraphOutput {
  std::string name;  // "talk.glb": its file name
  Source source;
};

// The "run" block: never part of a key.
struct RunSettings {
  std::int64_t memory_bytes = 0;  // 0 = not given
  double timeout_s = 0;
};

// The "sweep" block: never part of a key. Names as --set takes them ("flow.lambda", "levels"), and NODE.node for the kind of
// node.
struct SweepSettings {
  struct Vary {
    std::string name;
    std::vector<std::string> values;  // as --set takes them
    std::vector<std::string> shown;   // the same as written: a path is relative to its graph file
  };
  std::vector<Vary> vary;
  std::vector<std::string> metrics;
};

// A parameter that a graph declares; for commands that run a graph with its parameters as options.
struct GraphParam {
  ParamInfo info;  // name, doc, kind, list, choices; kind string for a path
  bool path = false;
  bool optional = false;
  bool has_default = false;
  bool given = false;  // it has a value in this reading: a default, or a setting
};

// A graph after extends, parameters and subgraphs are resolved. Absent nodes (a required input is unconnected) are
// gone.
struct Graph {
  std::string path;              // of the graph file; goes into the index only, never into a key
  std::vector<GraphNode> nodes;  // producers before consumers
  std::vector<GraphOutput> outputs;
  RunSettings run;
  SweepSettings sweep;
  std::vector<std::string> notes;  // what a setting of a node's kind left out: "flow: flow.dis has no parameter 'lambda'"
  std::vector<GraphParam> params;  // in the order declared
  std::string doc;                 // what the file says it is for

  int find_node(std::string_view id) const;  // index, or -1
};

// What a graph is read against.
struct GraphContext {
  std::function<const NodeInfo*(std::string_view)> find_node;  // null where there is none
  std::function<std::vector<std::string>()> node_names;        // for suggestions
  std::function<std::string(std::string_view)>
      absent_plugin;  // a sentence for a node of a plugin that could not be used, or empty
};

// --set NAME=VALUE as typed: "levels=6", "flow.levels=6", "audio=line.wav". Paths are relative to `folder`. "flow.node=flow.dis"
// puts another kind of node in its place; parameters of the graph file that this one lacks are left out, with a note.
struct Setting {
  std::string name;
  std::string value;
};

struct GraphReading {
  Graph graph;                    // complete only where problems is empty
  std::vector<Problem> problems;  // all of them, by file, line and column
};

// Reads and validates a graph file: everything that can be known before the run, all problems at once; one mistake is
// told once. Reads the graph's files, no other. folder: working directory, for the path and for paths in settings.
// Absent nodes are left out, and so are outputs that depend on them; no output left is a problem that names what to
// set.
GraphReading read_graph(const std::string& path, const std::vector<Setting>& settings, const std::string& folder,
                        const GraphContext& context);

// Splits "node.output[take03/17]" as references in graphs and on the command line are written.
struct Reference {
  std::string node;
  std::string output;                // empty = the only one
  std::vector<std::string> element;  // canonical ids
};
// Returns false, with a sentence in `error`, for what is no reference.
bool parse_reference(std::string_view text, Reference& reference, std::string& error);

}  // namespace engine
