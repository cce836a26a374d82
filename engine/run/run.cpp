// SPDX-License-Identifier: Apache-2.0
#include "engine/run/run.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>

#include "engine/run/session.h"

namespace engine {
namespace fs = std::filesystem;
using run::Session;
using run::Task;
using run::Tree;
namespace {

// Only what one node needs.
Graph reduced_to(const Graph& graph, int target) {
  Graph reduced = graph;
  reduced.outputs.clear();
  for (GraphNode& node : reduced.nodes) node.needed = false;
  reduced.nodes[static_cast<std::size_t>(target)].needed = true;
  for (std::size_t n = reduced.nodes.size(); n-- > 0;) {
    if (!reduced.nodes[n].needed) continue;
    for (const auto& port : reduced.nodes[n].inputs)
      for (const Source& source : port) {
        if (source.kind == Source::Kind::node) reduced.nodes[static_cast<std::size_t>(source.node)].needed = true;
        if (reduced.nodes[n].info->structural == Structural::first)
          break;  // the alternatives behind it are not looked at
      }
  }
  return reduced;
}

int find_or_throw(const Graph& graph, const std::string& id) {
  const int index = graph.find_node(id);
  if (index >= 0) return index;
  std::vector<std::string> names;
  for (const GraphNode& node : graph.nodes) names.push_back(node.id);
  throw std::invalid_argument("the graph has no node '" + id + "'" + did_you_mean(id, names));
}

void check_out_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw EngineError("cannot make the output folder " + folder + ": " + error.message());
  if (::access(folder.c_str(), W_OK) != 0)
    throw EngineError("cannot write to the output folder " + folder + ": " + std::strerror(errno));
}

PlannedTask planned(const Session& session, const Task& task) {
  PlannedTask entry;
  entry.node = session.node(task.node).id;
  entry.type = session.node(task.node).info->name;
  entry.element = task.element;
  entry.fate = task.state == Task::State::known ? PlannedTask::Fate::cached
               : task.key.empty()               ? PlannedTask::Fate::may_run
                                                : PlannedTask::Fate::runs;
  return entry;
}

// The trees that a task reads.
std::vector<Tree*> inputs_of(const Task& task) {
  std::vector<Tree*> trees;
  for (const auto& port : task.inputs)
    for (const run::Binding& binding : port)
      if (binding.tree) trees.push_back(binding.tree);
  if (task.prior) trees.insert(trees.end(), task.prior->outputs.begin(), task.prior->outputs.end());
  return trees;
}

struct EarlierFirst {
  bool operator()(const Task* a, const Task* b) const { return a->serial < b->serial; }
};
using TaskSet = std::set<const Task*, EarlierFirst>;

// The tasks behind a tree.
void producers_of(Tree* tree, TaskSet& found) {
  tree = follow(tree);
  if (tree->producer) {
    found.insert(tree->producer);
  } else if (tree->state == Tree::State::sequence) {
    for (Tree* child : tree->sequence->children) producers_of(child, found);
  }
}

std::string first_unknown(const Session& session, const Task& task) {
  for (Tree* tree : inputs_of(task)) {
    if (!tree->unknown) continue;
    TaskSet producers;
    producers_of(tree, producers);
    for (const Task* producer : producers)
      if (producer->state == Task::State::would_run) return session.name_of(*producer);
  }
  return {};
}

class Explainer {
 public:
  Explainer(Session& session, Store& store, const std::string& graph_path)
      : session_(session), store_(store), graph_path_(graph_path) {}

  Explanation explain(const Task& task) {
    Explanation result;
    result.task = session_.name_of(task);
    result.fate = planned(session_, task).fate;
    const Digest before = old_key(task);
    result.seen_before = !before.empty();
    if (result.fate == PlannedTask::Fate::cached && (before == task.key || before.empty())) return result;
    visited_.clear();
    causes_.clear();
    path_.clear();
    visit(task);
    result.causes = causes_;
    return result;
  }

 private:
  Digest old_key(const Task& task) {
    const std::string& node = session_.node(task.node).id;
    auto known = histories_.find(node);
    if (known == histories_.end()) {
      Past past;
      if (const auto history = store_.history(graph_path_, node)) {
        for (const NodeHistory::Entry& entry : history->entries) past.keys[entry.element] = entry.key;
        past.parts = history->parts;
      }
      known = histories_.emplace(node, std::move(past)).first;
    }
    const auto entry = known->second.keys.find(task.element);
    return entry == known->second.keys.end() ? Digest{} : entry->second;
  }

  void cause(const Task& task, std::string what) {
    // The same change of many elements is told once.
    for (Cause& known : causes_)
      if (known.what == what && known.task.substr(0, known.task.find('[')) == session_.node(task.node).id) {
        ++known.others;
        return;
      }
    if (causes_.size() >= most_causes) return;
    Cause found{session_.name_of(task), std::move(what), {}, 0};
    for (auto at = path_.rbegin(); at != path_.rend(); ++at) found.path.push_back(*at);
    causes_.push_back(std::move(found));
  }

  void visit(const Task& task) {
    if (!visited_.insert(&task).second) return;
    path_.push_back(session_.name_of(task));
    look(task);
    path_.pop_back();
  }

  // Producers whose own key is another than last time, or not known yet.
  // Along a recurrence the first of them is looked into, and none where the task has a cause of its own.
  bool upstream(const Task& task, bool has_own_cause = false) {
    TaskSet producers;
    for (Tree* tree : inputs_of(task)) producers_of(tree, producers);
    bool any = false;
    const auto changed = [&](const Task& other) { return other.key.empty() || other.key != old_key(other); };
    for (const Task* producer : producers) {
      if (!changed(*producer)) continue;
      any = true;
      if (producer == task.prior) {
        if (has_own_cause) continue;
        while (producer->prior && changed(*producer->prior)) producer = producer->prior;
      }
      visit(*producer);
    }
    return any;
  }

  void look(const Task& task) {
    const Digest before = old_key(task);
    if (before.empty()) {
      const std::size_t known = causes_.size();
      if (!histories_[session_.node(task.node).id].keys.empty())
        return cause(task, "element '" + task.element + "' is new");
      upstream(task);
      if (causes_.size() == known) cause(task, "this graph file has not run it before");
      return;
    }
    if (task.key == before) return cause(task, "its result is no longer in the store");
    // A cheap task has no record: what it shares with the node's other elements is in the node's history.
    const auto record = store_.find(before);
    const std::vector<KeyPart>& then = record ? record->parts : histories_[session_.node(task.node).id].parts;
    const bool inputs_known = record && !task.key.empty();
    bool found = false;
    for (const KeyPart& part : inputs_known ? session_.key_parts(task) : session_.own_parts(task)) {
      const auto old = std::find_if(then.begin(), then.end(), [&](const KeyPart& p) { return p.label == part.label; });
      if (old != then.end() && old->value == part.value) continue;
      found |= compare(task, part, old == then.end() ? nullptr : &*old);
    }
    if (upstream(task, found)) found = true;
    if (!found) found = sources(task);
    if (!found) cause(task, "the elements that it reads are others than before");
  }

  // Files that a task without a record reads: nothing else of it can have changed.
  bool sources(const Task& task) {
    bool any = false;
    for (const KeyPart& part : task.key.empty() ? std::vector<KeyPart>{} : session_.key_parts(task))
      if (part.origin.rfind("file:", 0) == 0) {
        cause(task, "file " + part.origin.substr(5) + " changed");
        any = true;
      }
    return any;
  }

  // True where the difference of one part is a cause of its own.
  bool compare(const Task& task, const KeyPart& part, const KeyPart* old) {
    if (part.label.rfind("parameter ", 0) == 0 || part.label == "version") {
      cause(task, part.label + ": " + (old ? old->value : "absent") + " -> " + part.value);
      return true;
    }
    if (part.label.rfind("plugin ", 0) == 0) {
      cause(task, part.label + " changed: " + (old ? old->value.substr(0, 12) : "absent") + " -> " +
                      part.value.substr(0, 12));
      return true;
    }
    const std::string path = part.origin.rfind("file:", 0) == 0 ? part.origin.substr(5) : std::string();
    if (!path.empty()) {
      const std::string before = old && old->origin.rfind("file:", 0) == 0 ? old->origin.substr(5) : std::string();
      if (before.empty() || before == path)
        cause(task, "file " + path + " changed: " + (old ? old->value.substr(0, 12) : "absent") + " -> " +
                        part.value.substr(0, 12));
      else
        cause(task, part.label + ": file " + before + " -> " + path);
      return true;
    }
    if (!old || part.value == "absent" || old->value == "absent") {
      if (old && part.value != old->value)
        cause(task, part.label + ": " + (old->value == "absent" ? "absent -> connected" : "connected -> absent"));
      return old != nullptr;
    }
    return false;  // an input made by a task: looked into there
  }

  static constexpr std::size_t most_causes = 20;
  Session& session_;
  Store& store_;
  const std::string& graph_path_;
  struct Past {
    std::map<std::string, Digest> keys;  // by element
    std::vector<KeyPart> parts;
  };
  std::map<std::string, Past> histories_;
  TaskSet visited_;
  std::vector<std::string> path_;
  std::vector<Cause> causes_;
};

}  // namespace

RunResult run_graph(const Graph& graph, Plugins& plugins, Store& store, const RunOptions& options) {
  if (!options.out_folder.empty() && options.to.empty()) check_out_folder(options.out_folder);
  const Graph* whole = &graph;
  Graph reduced;
  if (!options.to.empty()) {
    reduced = reduced_to(graph, find_or_throw(graph, options.to));
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

Plan plan_graph(const Graph& graph, Plugins& plugins, Store& store) {
  const RunOptions options;
  Session session(graph, plugins, store, options, Session::Mode::plan);
  session.expand();
  Plan plan;
  std::vector<bool> seen(graph.nodes.size(), false);
  for (const Task& task : session.tasks()) {
    seen[static_cast<std::size_t>(task.node)] = true;
    if (session.node(task.node).info->cheap && task.state == Task::State::known) continue;
    PlannedTask entry = planned(session, task);
    if (entry.fate == PlannedTask::Fate::may_run) entry.depends_on = first_unknown(session, task);
    (entry.fate == PlannedTask::Fate::cached ? plan.cached
     : entry.fate == PlannedTask::Fate::runs ? plan.runs
                                             : plan.may_run) += 1;
    plan.tasks.push_back(std::move(entry));
  }
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const GraphNode& node = graph.nodes[n];
    if (!node.needed || seen[n] || node.info->structural != Structural::none || node.mapped_depth == 0) continue;
    PlannedTask entry{PlannedTask::Fate::unknown_length, node.id, node.info->name, "", ""};
    for (std::size_t p = 0; p < node.inputs.size(); ++p)
      for (const Source& source : node.inputs[p])
        if (entry.depends_on.empty() && source.kind == Source::Kind::node &&
            node.input_depth[p] > node.info->inputs[p].depth)
          entry.depends_on = graph.nodes[static_cast<std::size_t>(source.node)].id;
    plan.tasks.push_back(std::move(entry));
  }
  std::stable_sort(plan.tasks.begin(), plan.tasks.end(), [&](const PlannedTask& a, const PlannedTask& b) {
    return graph.find_node(a.node) < graph.find_node(b.node);
  });
  return plan;
}

std::vector<Explanation> explain_node(const Graph& graph, Plugins& plugins, Store& store, const std::string& node,
                                      const std::string& element) {
  const int target = find_or_throw(graph, node);
  const RunOptions options;
  const Graph reduced = reduced_to(graph, target);
  Session session(reduced, plugins, store, options, Session::Mode::plan);
  session.expand();
  Explainer explainer(session, store, graph.path);
  std::vector<Explanation> result;
  for (const Task& task : session.tasks())
    if (task.node == target && (element.empty() || task.element == element)) result.push_back(explainer.explain(task));
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
  const int target = find_or_throw(graph, reference.node);
  const GraphNode& node = graph.nodes[static_cast<std::size_t>(target)];
  int output = 0;
  if (!reference.output.empty()) {
    output = node.info->find_output(reference.output);
    if (output < 0) {
      std::vector<std::string> names;
      for (const OutputInfo& info : node.info->outputs) names.push_back(info.name);
      throw std::invalid_argument("node '" + reference.node + "' has no output '" + reference.output + "'" +
                                  did_you_mean(reference.output, names));
    }
  }
  const int depth = node.output_depth[static_cast<std::size_t>(output)];
  if (static_cast<int>(reference.element.size()) != depth)
    throw std::invalid_argument("output '" + node.info->outputs[static_cast<std::size_t>(output)].name + "' of node '" +
                                reference.node + "' is " +
                                (depth == 0 ? "one value" : "a sequence " + std::to_string(depth) + " deep") +
                                ", so it is named " + reference.node +
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
  const Graph reduced = reduced_to(graph, target);
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
