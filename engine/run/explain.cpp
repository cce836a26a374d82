// SPDX-License-Identifier: Apache-2.0
// Why tasks would rerun.
#include <algorithm>
#include <map>

#include "engine/run/run.h"
#include "engine/run/upstream.h"

namespace engine {
using run::Session;
using run::Task;
using run::TaskSet;
using run::Tree;
namespace {

class Explainer {
 public:
  Explainer(Session& session, Store& store, const std::string& graph_path)
      : session_(session), store_(store), graph_path_(graph_path) {}

  Explanation explain(const Task& task) {
    Explanation result;
    result.task = session_.name_of(task);
    result.fate = run::fate_of(task);
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
    for (Tree* tree : run::inputs_of(task)) run::producers_of(tree, producers);
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

std::vector<Explanation> explain_node(const Graph& graph, Plugins& plugins, Store& store, const std::string& node,
                                      const std::string& element) {
  const int target = run::find_or_throw(graph, node);
  const RunOptions options;
  const Graph reduced = run::reduced_to(graph, target);
  Session session(reduced, plugins, store, options, Session::Mode::plan);
  session.expand();
  Explainer explainer(session, store, graph.path);
  std::vector<Explanation> result;
  for (const Task& task : session.tasks())
    if (task.node == target && (element.empty() || task.element == element)) result.push_back(explainer.explain(task));
  return result;
}

}  // namespace engine
