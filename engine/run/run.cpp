// SPDX-License-Identifier: Apache-2.0
#include "engine/run/run.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>

#include "engine/run/upstream.h"

namespace engine {
namespace fs = std::filesystem;
using run::Session;
using run::Task;
using run::Tree;
namespace {

void check_out_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw EngineError("cannot make the output folder " + folder + ": " + error.message());
  if (::access(folder.c_str(), W_OK) != 0)
    throw EngineError("cannot write to the output folder " + folder + ": " + std::strerror(errno));
}

}  // namespace

RunResult run_graph(const Graph& graph, Plugins& plugins, Store& store, const RunOptions& options) {
  if (!options.out_folder.empty() && options.to.empty()) check_out_folder(options.out_folder);
  const Graph* whole = &graph;
  Graph reduced;
  if (!options.to.empty()) {
    reduced = run::reduced_to(graph, run::find_or_throw(graph, options.to));
    whole = &reduced;
  }
  Session session(*whole, plugins, store, options, Session::Mode::run);
  session.expand();
  session.work();
  RunResult result;
  session.finish_run(result);
  if (!options.elements.empty() && result.failures.empty() && !result.cancelled) {
    const int target = whole->find_node(options.to);
    const auto& tasks = session.tasks();
    if (std::none_of(tasks.begin(), tasks.end(), [&](const Task& task) { return task.node == target; }))
      result.failures.push_back(options.to + ": it has none of the elements asked for");
  }
  if (!options.out_folder.empty() && options.to.empty() && !result.cancelled) session.publish_outputs(result);
  return result;
}

AuditResult audit_graph(const Graph& graph, Plugins& plugins, Store& store, double fraction, std::uint64_t seed,
                        const RunOptions& options) {
  Session session(graph, plugins, store, options, Session::Mode::plan);
  session.expand();
  AuditResult result;
  result.stored = session.choose_for_audit(fraction, seed);
  for (const Task& task : session.tasks()) result.checked += task.audited;
  session.work();
  RunResult ended;
  session.count(ended);
  if (ended.cancelled) throw std::runtime_error("the audit was interrupted");
  result.differing = ended.failures;
  return result;
}

std::vector<Digest> values_of(const Graph& graph, Plugins& plugins, Store& store) {
  const RunOptions options;
  Session session(graph, plugins, store, options, Session::Mode::plan);
  session.expand();
  std::set<Digest> digests;
  const auto add = [&](const Tree* leaf) {
    if (leaf->cheap || !leaf->has_identity) return;
    digests.insert(leaf->identity);
    const run::StoredFile file = run::stored_file(leaf->identity, store);
    if (file.known) digests.insert(file.content);
  };
  for (const Task& task : session.tasks()) {
    if (task.state != Task::State::known) continue;
    for (const Tree* output : task.outputs) {
      if (output->state == Tree::State::leaf) add(output);
      if (output->state == Tree::State::sequence)
        for (Tree* child : output->sequence->children) add(follow(child));
    }
  }
  return {digests.begin(), digests.end()};
}

GotValue get_value(const Graph& graph, Plugins& plugins, Store& store, const Reference& reference,
                   const RunOptions& given) {
  const int target = run::find_or_throw(graph, reference.node);
  const GraphNode& node = graph.nodes[static_cast<std::size_t>(target)];
  int output = 0;
  if (!reference.output.empty()) {
    output = node.info->find_output(reference.output);
    if (output < 0) {
      std::vector<std::string> names;
      for (const OutputInfo& info : node.info->outputs) names.push_back(info.name);
      throw std::invalid_argument("node '" + reference.node + "' has no output '" + reference.output + "'" +
                                  did_you_mean_of(reference.output, names));
    }
  }
  const int depth = node.output_depth[static_cast<std::size_t>(output)];
  if (static_cast<int>(reference.element.size()) != depth)
    throw std::invalid_argument("output '" + node.info->outputs[static_cast<std::size_t>(output)].name + "' of node '" +
                                reference.node + "' is " +
                                (depth == 0 ? "one value" : "a sequence " + std::to_string(depth) + " deep") +
                                ", so it is named " + reference.node +
                                (reference.output.empty() ? "" : "." + reference.output) +
                                (depth == 0   ? ""
                                 : depth == 1 ? "[ID]"
                                              : "[ID/ID]"));
  RunOptions options = given;
  options.to = reference.node;
  options.out_folder.clear();
  std::string path;
  for (int i = 0; i < node.mapped_depth; ++i)
    path += (i == 0 ? "" : "/") + reference.element[static_cast<std::size_t>(i)];
  if (!path.empty()) options.elements = {path};
  const Graph reduced = run::reduced_to(graph, target);
  Session session(reduced, plugins, store, options, Session::Mode::run);
  session.expand();
  Tree* tree = nullptr;
  {
    const std::lock_guard guard(session.lock());
    Source source;
    source.kind = Source::Kind::node;
    source.node = target;
    source.output = output;
    source.element = reference.element;
    tree = session.output_tree(source);
    ++tree->uses;
  }
  session.work();
  RunResult result;
  session.finish_run(result);
  if (!result.failures.empty()) throw std::runtime_error(result.failures.front());
  if (result.cancelled) throw std::runtime_error("the run ended before the value was made");
  tree = follow(tree);
  if (tree->state != Tree::State::leaf) throw std::runtime_error("the run ended before the value was made");
  const TypeInfo* type = nullptr;
  const std::string& type_name = node.output_type[static_cast<std::size_t>(output)];
  for (const TypeInfo* builtin :
       {&type_of<double>(), &type_of<std::int64_t>(), &type_of<bool>(), &type_of<std::string>(), &type_of<File>()})
    if (builtin->name == type_name) type = builtin;
  if (!type) type = plugins.load_type(type_name);
  if (!type) throw std::runtime_error("no plugin has the type '" + type_name + "'");
  return {session.fetch(tree, *type), tree->identity};
}

}  // namespace engine
