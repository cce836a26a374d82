// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <queue>
#include <set>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "engine/run/run.h"
#include "engine/run/tree.h"
#include "engine/run/values.h"

namespace engine::run {

class Session;
class Level;

// Thrown through a streaming node when nobody wants the rest of its sequence. Not a std::exception: nodes shall not
// catch it.
struct PassDone {};
// Thrown through a node when the run ends.
struct Stopped {};

// What one port of a task, or of a level of mapping, is bound to.
struct Binding {
  Tree* tree = nullptr;   // null: unconnected, or absent in a sparse sequence
  int excess = 0;         // levels above what the port takes: to be mapped
  bool windowed = false;  // tree is the sequence around element `index`
  std::size_t index = 0;
};
using Bindings = std::vector<std::vector<Binding>>;  // per port, per source (one, but at variadic ports)

// One function call: a node at one element.
struct Task final : Watcher {
  enum class State : std::uint8_t {
    waiting,  // for the identities of its inputs
    known,    // its outputs' identities are known; values may have to be made
    wanted,   // it will run, once its inputs' values are there
    ready,    // in the queue
    running,
    failed,
    blocked,
    would_run  // planning
  };
  Session* session = nullptr;
  int node = 0;
  State state = State::waiting;
  bool repeated = false;      // its outputs are known; it runs to make values again
  bool released = false;      // its inputs are no longer in use
  bool audited = false;       // it runs again to the end, to be compared
  bool awaited = false;       // a running task stands still until it has run
  std::uint8_t refusals = 0;  // how often another process held its key
  std::uint32_t worker = 0;   // the thread that runs or ran it, from 1
  std::uint32_t serial = 0;
  std::uint32_t waits = 0;         // unsettled inputs
  std::uint32_t missing = 0;       // values asked for
  std::string element;             // "take03/17"
  std::vector<ParamValue> params;  // only where overridden
  Bindings inputs;
  Task* prior = nullptr;
  std::vector<Tree*> outputs;
  Digest key;
  double progress = 0;
  std::vector<std::string> warnings;

  void update(Tree* changed) override;
};

// A set of element ids as people write it: "17-23", "40", "take03/5", "take03" (with all below it).
class ElementFilter {
 public:
  explicit ElementFilter(const std::vector<std::string>& texts);
  bool empty() const { return ranges_.empty(); }
  // Could an element with this path, or one below it, be meant?
  bool admits(const std::string& path) const;

 private:
  std::vector<Override::Range> ranges_;
};

// One level of mapping of a node: makes a task, or a further level, for every element as its inputs grow.
class Level final : public Watcher {
 public:
  Level(Session& session, int node, Bindings inputs, std::string path, std::vector<Tree*> outputs);
  void start();
  void update(Tree* changed) override;

 private:
  struct Driver {
    std::size_t port, source;
    Tree* tree;
    bool window;
    int before, after;
  };
  bool ready_for(std::size_t index);
  void add(std::size_t index);
  void finish();
  void fail_level(const std::string& text);

  Session& session_;
  int node_;
  Bindings inputs_;
  std::string path_;
  std::vector<Tree*> outputs_;
  std::vector<Driver> required_, sparse_;
  std::size_t made_ = 0;
  Task* last_ = nullptr;
  bool done_ = false;
};

// A node that only rearranges, at one element.
class Rearrangement final : public Watcher {
 public:
  Rearrangement(Session& session, int node, Bindings inputs, std::vector<Tree*> outputs);
  void start();
  void update(Tree* changed) override;

 private:
  void list_files();
  void pass_through();  // select, slice, every, where, ids
  void pick();
  void flatten();
  void merge();
  bool keeps(std::size_t index, const std::string& id);
  void fail(const std::string& why);

  Session& session_;
  int node_;
  std::vector<std::vector<Tree*>> inputs_;
  std::optional<ElementFilter> chosen_;  // select
  Tree* output_;
  std::size_t next_ = 0, inner_ = 0;
  Tree* watched_ = nullptr;  // flatten: the inner sequence that it waits for
  bool done_ = false;
};

// node[17]: one element of a sequence.
class Pick final : public Watcher {
 public:
  Pick(Session& session, Tree* from, std::vector<std::string> ids, Tree* to, std::string shown);
  void update(Tree* changed) override;

 private:
  Session& session_;
  Tree* from_;
  std::vector<std::string> ids_;
  std::size_t seen_ = 0;  // children that are not the one
  Tree* to_;
  std::string shown_;
  bool done_ = false;
};

// The elements of a windowed binding: [begin, end) of the sequence around it.
struct Span {
  std::size_t begin, end;
};
Span span_of(const Binding& binding, const InputInfo& port);

bool in_range(const std::string& id, const std::string& first, const std::string& last);
std::vector<std::string> split_path(const std::string& path);  // "take03/17" at its slashes

// One run (or plan) of one graph: the trees, the tasks, and the workers.
class Session {
 public:
  enum class Mode { run, plan };
  Session(const Graph& graph, Plugins& plugins, Store& store, const RunOptions& options, Mode mode);
  ~Session();

  // Makes the trees of all needed nodes and resolves what can be resolved.
  void expand();
  // Runs until nothing is left to do.
  void work();
  // Has a sample of the tasks that the store has run again, to be compared; says how many.
  std::size_t choose_for_audit(double fraction, std::uint64_t seed);

  Tree* output_tree(const Source& source);
  std::vector<Tree*> node_outputs(int node) const { return outputs_[static_cast<std::size_t>(node)]; }
  const std::deque<Task>& tasks() const { return tasks_; }
  const GraphNode& node(int index) const { return graph_.nodes[static_cast<std::size_t>(index)]; }
  const std::vector<ParamValue>& params_of(const Task& task) const;
  std::vector<KeyPart> key_parts(const Task& task);   // everything that went into its key
  std::vector<KeyPart> own_parts(const Task& task);   // without its inputs: version, plugin, parameters
  std::vector<KeyPart> shared_parts(int node_index);  // the same of a node without overrides
  std::string name_of(const Task& task) const;
  // The value of a leaf: from memory, the store, or made anew. May wait; call without the lock. `sequence`: the one it
  // is read from in order, at `index`.
  Value fetch(Tree* leaf, const TypeInfo& type, const Tree* sequence = nullptr, std::size_t index = 0);
  void count(RunResult& result);
  void finish_run(RunResult& result);  // counts, histories
  void note_failure(const std::string& text) { failures_.push_back(text); }
  std::mutex& lock() { return mutex_; }
  void publish_outputs(RunResult& result);

 private:
  friend struct Task;
  friend class Level;
  friend class Rearrangement;
  friend class Pick;
  friend class TaskCall;
  friend class TaskProgress;
  friend class TreeAccess;

  // --- trees.cpp
  Tree* new_tree();
  Tree* new_sequence();
  Tree* source_tree(const Source& source);
  void add_child(Tree* sequence, std::string id, Tree* child);
  void complete(Tree* sequence);
  void settle(Tree* tree);
  void fail_tree(Tree* tree);
  void set_forward(Tree* tree, Tree* target);
  void watch_growth(Tree* tree, Watcher* watcher);
  bool watch_settling(Tree* tree, Watcher* watcher);  // false where it is settled already
  void notify_growth(Tree* tree);
  const Digest& identity_of(Tree* tree);
  // --- expand.cpp
  void instantiate(int node, Bindings inputs, const std::string& path, const std::vector<Tree*>& outputs, Task** made,
                   Task* prior, bool has_prior);
  Task* make_task(int node, Bindings inputs, const std::string& path, const std::vector<Tree*>& outputs, Task* prior);
  void restrict_to_elements();

  // --- resolve.cpp: keys and records
  void settled_inputs(Task& task) { to_resolve_.push_back(&task); }
  void drain();  // resolves what has settled; a queue, since chains of priors are thousands long
  void resolve(Task& task);
  Digest key_of(Task& task);
  std::vector<KeyPart> parts_with(int node_index, const std::vector<ParamValue>& params);
  const Digest& prefix_of(int node, const std::vector<ParamValue>* overridden);
  void install(Task& task, const std::vector<OutputRecord>& outputs);
  void install_cheap(Task& task);
  void tell_old_warnings(Task& task);
  void block(Task& task);
  void would_run(Task& task);
  void each_input_leaf(
      Task& task, const std::function<void(Tree*)>& visit);  // direct leaves: values, window elements, prior outputs

  // --- memory.cpp
  bool available(Tree* leaf);
  void read_ahead(const Tree& sequence, std::size_t index);
  void hold_value(Tree* leaf, Value value);
  void drop_value(Tree* leaf);
  void make_room(bool cheap_too);
  bool wanted(const Tree* leaf) const;  // somebody reads it, or will
  void drop_unused(Tree* leaf);
  void release_inputs(Task& task);
  // --- workers.cpp
  void enqueue(Task& task);
  void wake_worker();
  void tell_blocked();
  void worker();
  void start_worker();
  void join_workers();
  bool idle() const { return ready_.empty() && held_.empty() && running_ == 0; }
  void postpone(Task& task);
  void readmit();
  void throttle(std::unique_lock<std::mutex>& guard);
  void wait_blocked(std::unique_lock<std::mutex>& guard, const std::function<bool()>& until);
  // --- execute.cpp
  void launch(Task& task);
  void await(Task& task);
  void produce(Task& task);
  void run_task(Task& task, std::unique_lock<std::mutex>& guard);
  void compute(Task& task, std::vector<OutputRecord>& records, std::chrono::steady_clock::time_point begin);
  void finish_task(Task& task, const std::vector<OutputRecord>& records);
  void fail_task(Task& task, const std::string& text);
  void emit(RunEvent::Kind kind, const Task& task, std::string text = {}, double seconds = 0);
  double now() const;
  // --- batch.cpp: cheap tasks of microseconds
  bool is_light(int node) const;
  bool suits_batch(const Task& task) const;
  void note_pace(int node, double seconds_per_task);
  void run_batch(std::unique_lock<std::mutex>& guard);
  static std::uint32_t current_worker();
  // --- call_node.cpp
  std::vector<OutputRecord> call_node(Task& task);
  void accept_element(Task& task, std::size_t output, std::string id, Value value, OutputRecord& record);
  void compare_length(const Task& task, std::size_t output, const OutputRecord& record);
  bool wanted_from(const Task& task, std::size_t output, std::size_t from) const;
  std::vector<std::string> source_paths(const Task& task);
  void check_sources(const std::vector<std::string>& paths) const;

  const Graph& graph_;
  Plugins& plugins_;
  Store& store_;
  const RunOptions& options_;
  const Mode mode_;
  ElementFilter filter_;
  std::vector<bool> filtered_;  // per node: only elements that the filter admits

  std::mutex mutex_;
  std::deque<Tree> trees_;
  std::deque<Task> tasks_;
  std::vector<std::unique_ptr<Watcher>> watchers_;
  std::vector<std::vector<Tree*>> outputs_;  // per node, per output
  std::vector<Tree*> output_roots_;          // per output of the graph
  std::map<std::string, Tree*> sources_;
  struct OpenedSource {
    std::string path;
    std::vector<std::string> files;  // every one that was read
  };
  std::unordered_map<const Tree*, OpenedSource> opened_;
  std::map<int, Digest> prefixes_;
  struct Pace {
    bool simple = false;     // cheap, one value per port: what may run in a batch
    std::uint8_t quick = 0;  // of the last eight tasks, or batches, those that took microseconds: a bit each
  };
  std::vector<Pace> paces_;  // per node
  std::deque<Task*> to_resolve_;
  bool draining_ = false;

  struct Before {
    bool operator()(const Task* a, const Task* b) const;
  };
  std::set<Task*, Before> ready_;
  Task& next_ready() const { return **ready_.begin(); }
  struct Postponed {
    std::chrono::steady_clock::time_point until;
    Task* task;
    bool operator<(const Postponed& other) const { return until > other.until; }
  };
  std::priority_queue<Postponed> held_;  // tasks whose key another process holds
  std::condition_variable work_;         // something became ready
  std::condition_variable changed_;      // a value that somebody waits for is there, or memory fell
  std::condition_variable ended_;        // nothing is left to do, or something is wrong with the whole
  std::vector<std::thread> threads_;
  std::uint32_t started_workers_ = 0;
  int alive_ = 0;    // workers
  int active_ = 0;   // of them, those at work and not blocked
  int running_ = 0;  // tasks running, blocked ones included
  int sleeping_ = 0;  // workers that wait for a task
  int napping_ = 0;   // of them, those that look again within a millisecond
  int blocked_ = 0;   // threads waiting for a value or for memory
  int most_workers_ = 1;
  std::atomic<bool> stopped_ = false;  // written under the lock; running nodes look at it without
  std::int64_t budget_ = 0;
  std::int64_t used_ = 0;
  std::size_t dropped_ = 0;  // bytes since the heaps were looked at
  std::deque<Tree*> resident_;  // leaves that hold a value, oldest first
  RunCounts counts_;
  std::size_t known_tasks_ = 0;
  std::vector<std::string> failures_;
  std::exception_ptr fatal_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace engine::run
