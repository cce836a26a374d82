// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <set>

#include "engine/graph/flat_graph.h"
#include "engine/graph/override_overlap.h"

namespace engine {
namespace {

// Of a file that is not there: one in its folder with nearly that name, or what became of a "~".
std::string meant_file(const Link& link) {
  if (link.shown_path.starts_with("~"))
    return ": a shell puts the home folder in the place of ~ only where a word begins with it, so write $HOME";
  const std::filesystem::path path(link.path);
  std::vector<std::string> names;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path(), code))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());  // of equally near ones the first
  return did_you_mean(path.filename().string(), names);
}

constexpr int unknown = -1;  // a depth that follows from something that is reported already

// What is known of a link or an output before the run.
struct Shape {
  std::string type;  // empty = unknown
  int depth = unknown;
  bool absent = false;
  bool broken = false;
};

std::string shape_text(const std::string& type, int depth) {
  std::string text = type.empty() ? "any type" : type;
  for (int i = 0; i < depth; ++i) text = "Seq<" + text + ">";
  return text;
}

std::string levels(int depth) {
  if (depth == 0) return "a single value";
  return depth == 1 ? "a sequence" : "a sequence of depth " + std::to_string(depth);
}

class Analysis {
 public:
  Analysis(const FlatGraph& flat, Graph& graph, std::vector<Problem>& problems)
      : flat_(flat), graph_(graph), problems_(problems) {}

  void run() {
    states_.resize(flat_.nodes.size());
    checks_.resize(flat_.input_checks.size());
    on_ring_.resize(flat_.nodes.size());
    order_ = find_order(flat_, on_ring_, problems_);
    for (const int node : order_) settle(node);
    for (std::size_t i = 0; i < checks_.size(); ++i) check_input(static_cast<int>(i));
    read_outputs();
    mark_needed();
    check_files();
    emit();
  }

 private:
  struct State {
    bool settled = false;
    bool absent = false;
    bool broken = false;
    bool needed = false;
    int mapped_depth = 0;
    std::vector<int> input_depth;
    std::vector<Shape> outputs;
  };
  enum class Check { open, good, bad };

  void problem(const Place& place, std::string text) { problems_.push_back({place, std::move(text)}); }

  Shape shape_of(const Link& link) {
    Shape shape;
    switch (link.kind) {
      case Link::Kind::broken:
        shape.broken = true;
        return shape;
      case Link::Kind::unset:
        shape.absent = true;
        [[fallthrough]];
      case Link::Kind::file:
        shape.type = "file";
        shape.depth = 0;
        break;
      case Link::Kind::node: {
        const State& producer = states_[link.node];
        if (!producer.settled || flat_.nodes[link.node].info == nullptr) {
          shape.broken = true;
          return shape;
        }
        shape = producer.outputs[link.output];
        shape.broken = false;
        shape.absent = producer.absent;
        break;
      }
    }
    if (link.input_check >= 0 && check_input(link.input_check) == Check::bad) {
      shape.broken = true;
      return shape;
    }
    const int selected = static_cast<int>(link.element.size());
    if (shape.depth != unknown && selected > 0) {
      if (selected > shape.depth) {
        std::string name = "the file";
        if (link.kind == Link::Kind::node) name = "'" + flat_.nodes[link.node].id + "'";
        problem(link.place, "the reference selects an element " + std::to_string(selected) +
                                (selected == 1 ? " level" : " levels") + " deep, but " + name + " is " +
                                levels(shape.depth));
        shape.broken = true;
        return shape;
      }
      shape.depth -= selected;
    }
    return shape;
  }

  // What a subgraph's input is given must be of the type that it declares; deeper sequences map the subgraph.
  Check check_input(int index) {
    if (checks_[index] != Check::open) return checks_[index];
    const InputCheck& input = flat_.input_checks[index];
    checks_[index] = Check::good;
    const Shape shape = shape_of(input.link);
    const std::string expected = shape_text(input.type, input.depth);
    if (shape.broken) {
      checks_[index] = Check::bad;
    } else if ((!input.type.empty() && !shape.type.empty() && shape.type != input.type) ||
               (shape.depth != unknown && shape.depth < input.depth)) {
      problem(input.link.place, "the input '" + input.name + "' takes " + expected + ", but is given " +
                                    shape_text(shape.type, std::max(shape.depth, 0)));
      checks_[index] = Check::bad;
    }
    return checks_[index];
  }

  std::string port_name(const FlatNode& node, std::size_t port) const {
    return "the input '" + node.info->inputs[port].name + "' of '" + node.info->name + "'";
  }

  // What the links of a port have in common. What does not agree is reported.
  struct Agreed {
    std::string type;
    int depth = unknown;
    bool depth_known = true;  // every link that counts has one
  };

  bool takes_type(const FlatNode& node, std::size_t port, const Link& link, const Shape& shape, Agreed& agreed) {
    const std::string& declared = node.info->inputs[port].type;
    if (shape.type.empty() || shape.type == agreed.type) return true;  // of unknown ones the cause is reported
    if (agreed.type.empty()) {
      agreed.type = shape.type;
      return true;
    }
    if (declared.empty())
      problem(link.place, port_name(node, port) + " takes alternatives of one type: found '" + shape.type +
                              "' after '" + agreed.type + "'");
    else
      problem(link.place, port_name(node, port) + " takes '" + declared + "', found '" + shape.type + "'");
    return false;
  }

  bool takes_depth(const FlatNode& node, std::size_t port, const Link& link, const Shape& shape, Agreed& agreed) {
    const InputInfo& input = node.info->inputs[port];
    const int least = input.window ? 1 : input.depth;
    if (shape.depth == unknown) return false;
    if (node.info->structural != Structural::first && shape.depth < least) {
      problem(link.place, port_name(node, port) + " takes " + levels(least) + ", found " + levels(shape.depth));
      return false;
    }
    if (agreed.depth != unknown && shape.depth != agreed.depth) {
      problem(link.place, port_name(node, port) + " takes alternatives of one depth: found " + levels(shape.depth) +
                              " after " + levels(agreed.depth));
      return false;
    }
    agreed.depth = shape.depth;
    return true;
  }

  // What is present counts; an absent node is checked as if all were.
  Agreed agree(const FlatNode& node, std::size_t port, const std::vector<Shape>& shapes, bool node_is_absent) {
    Agreed agreed{node.info->inputs[port].type};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const Shape& shape = shapes[i];
      const Link& link = node.ports[port][i];
      if (shape.broken || !takes_type(node, port, link, shape, agreed))
        agreed.depth_known = false;
      else if ((!shape.absent || node_is_absent) && !takes_depth(node, port, link, shape, agreed))
        agreed.depth_known = false;
    }
    return agreed;
  }

  // Decides whether a node is absent, and finds its depths and types.
  void settle(int index) {
    const FlatNode& node = flat_.nodes[index];
    State& state = states_[index];
    if (node.info == nullptr) return;
    const NodeInfo& info = *node.info;
    std::vector<std::vector<Shape>> shapes(node.ports.size());
    state.broken = node.input_missing || on_ring_[index];
    for (std::size_t port = 0; port < node.ports.size(); ++port) {
      for (const Link& link : node.ports[port]) shapes[port].push_back(shape_of(link));
      const auto& given = shapes[port];
      const bool all_absent = !given.empty() && std::all_of(given.begin(), given.end(), [](const Shape& shape) {
        return shape.absent && !shape.broken;
      });
      if (all_absent && !info.inputs[port].optional) state.absent = true;
    }
    state.input_depth.assign(node.ports.size(), 0);
    state.mapped_depth = 0;
    Agreed first;
    bool depth_known = !state.broken;
    for (std::size_t port = 0; port < node.ports.size(); ++port) {
      const Agreed agreed = agree(node, port, shapes[port], state.absent);
      depth_known = depth_known && agreed.depth_known;
      if (port == 0) first = agreed;
      if (agreed.depth == unknown) continue;
      state.input_depth[port] = agreed.depth;
      if (info.structural != Structural::first)
        state.mapped_depth = std::max(state.mapped_depth, agreed.depth - info.inputs[port].depth);
    }
    check_where(node, shapes, state);
    if (depth_known && info.prior && state.mapped_depth == 0)
      problem(node.place,
              "'" + info.name +
                  "' works along a sequence (each result follows from the one before), but none of its inputs is one");

    for (const OutputInfo& output : info.outputs) {
      Shape shape;
      shape.type = output.type.empty() ? first.type : output.type;
      if (depth_known)
        shape.depth = info.structural == Structural::first ? first.depth : state.mapped_depth + output.depth;
      state.outputs.push_back(shape);
    }
    if (depth_known) check_overrides(node, state.mapped_depth, problems_);
    state.settled = !on_ring_[index];
  }

  // The flags of seq.where are those of its own sequence, not of an outer or inner one.
  void check_where(const FlatNode& node, const std::vector<std::vector<Shape>>& shapes, const State& state) {
    if (node.info->structural != Structural::where || shapes[0].empty() || shapes[1].empty()) return;
    const Shape& sequence = shapes[0][0];
    const Shape& flags = shapes[1][0];
    if (sequence.broken || flags.broken || sequence.depth < 1 || flags.depth < 1 || sequence.depth == flags.depth ||
        state.broken)
      return;
    problem(node.ports[1][0].place, port_name(node, 1) + " takes one flag for every element of the sequence: found " +
                                        levels(flags.depth) + " for " + levels(sequence.depth));
  }

  void read_outputs() {
    std::set<std::string> causes;
    bool any = flat_.outputs_reported;
    for (const FlatOutput& output : flat_.outputs) {
      const Shape shape = shape_of(output.link);
      any = any || shape.broken || !shape.absent;
      if (shape.broken) continue;
      if (!shape.type.empty() && shape.type != "file")
        problem(output.link.place, "the output " + quoted_text(output.name) + " is of type '" + shape.type +
                                       "', expected 'file': let a node export it first");
      else if (shape.absent)
        find_causes(output.link, causes);
      else
        outputs_.push_back(&output);
    }
    for (const std::string& param : flat_.misspelt) any = any || causes.contains(param);
    if (any) return;
    std::string names;
    for (const std::string& cause : causes) names += (names.empty() ? "" : " or ") + ("--set " + cause + "=PATH");
    problem(flat_.outputs[0].place, "no output is left, since optional parameters are unset: " + names);
  }

  void find_causes(const Link& from, std::set<std::string>& causes) const {
    std::vector<const Link*> open{&from};
    std::vector<bool> seen(flat_.nodes.size(), false);
    while (!open.empty()) {
      const Link& link = *open.back();
      open.pop_back();
      if (link.kind == Link::Kind::unset) causes.insert(link.unset_param);
      if (link.kind != Link::Kind::node || seen[link.node] || !states_[link.node].absent) continue;
      seen[link.node] = true;
      const FlatNode& node = flat_.nodes[link.node];
      for (std::size_t port = 0; port < node.ports.size(); ++port)
        if (!node.info->inputs[port].optional)
          for (const Link& next : node.ports[port]) open.push_back(&next);
    }
  }

  void mark_needed() {
    std::vector<int> open;
    const auto need = [&](const Link& link) {
      if (link.kind != Link::Kind::node || states_[link.node].absent || states_[link.node].needed) return;
      states_[link.node].needed = true;
      open.push_back(link.node);
    };
    for (const FlatOutput& output : flat_.outputs) need(output.link);
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      const bool first_only = flat_.nodes[node].info->structural == Structural::first;
      for (const auto& links : flat_.nodes[node].ports)
        for (const Link& link : links) {
          const bool present =
              link.kind == Link::Kind::file || (link.kind == Link::Kind::node && !states_[link.node].absent);
          need(link);
          if (first_only && present) break;  // the alternatives behind it are not looked at
        }
    }
  }

  void check_files() {
    std::set<std::string> checked;
    for (std::size_t i = 0; i < flat_.nodes.size(); ++i) {
      if (!states_[i].needed) continue;
      for (const auto& links : flat_.nodes[i].ports)
        for (const Link& link : links) {
          if (link.kind != Link::Kind::file || !checked.insert(link.path).second) continue;
          std::error_code code;
          const auto status = std::filesystem::status(link.path, code);
          if (!std::filesystem::exists(status))
            problem(link.value_place, "the file " + link.shown_path + " does not exist" + meant_file(link));
          else if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_directory(status))
            problem(link.value_place, link.shown_path + " is neither a file nor a folder");
        }
    }
  }

  Source source_of(const Link& link, const std::vector<int>& position) const {
    Source source;
    source.place = link.place;
    source.element = link.element;
    if (link.kind == Link::Kind::file) {
      source.kind = Source::Kind::file;
      source.path = link.path;
      source.shown_path = link.shown_path;
    } else if (link.kind == Link::Kind::node && position[link.node] >= 0) {
      source.kind = Source::Kind::node;
      source.node = position[link.node];
      source.output = link.output;
    }
    return source;
  }

  void emit() {
    std::vector<int> position(flat_.nodes.size(), -1);
    for (const int index : order_) {
      const FlatNode& node = flat_.nodes[index];
      State& state = states_[index];
      if (state.absent || node.info == nullptr || !state.settled) continue;
      GraphNode result;
      result.id = node.id;
      result.info = node.info;
      result.params = node.params;
      result.overrides = node.overrides;
      result.mapped_depth = state.mapped_depth;
      result.input_depth = state.input_depth;
      for (const Shape& shape : state.outputs) {
        result.output_depth.push_back(shape.depth);
        result.output_type.push_back(shape.type);
      }
      result.needed = state.needed;
      result.place = node.place;
      for (const auto& links : node.ports) {
        std::vector<Source>& sources = result.inputs.emplace_back();
        for (const Link& link : links)
          if (Source source = source_of(link, position); source.kind != Source::Kind::none)
            sources.push_back(std::move(source));
      }
      position[index] = static_cast<int>(graph_.nodes.size());
      graph_.nodes.push_back(std::move(result));
    }
    for (const FlatOutput* output : outputs_)
      if (Source source = source_of(output->link, position); source.kind == Source::Kind::node)
        graph_.outputs.push_back({output->name, std::move(source)});
  }

  const FlatGraph& flat_;
  Graph& graph_;
  std::vector<Problem>& problems_;
  std::vector<State> states_;
  std::vector<Check> checks_;
  std::vector<int> order_;
  std::vector<bool> on_ring_;
  std::vector<const FlatOutput*> outputs_;
};

}  // namespace

void analyse_graph(const FlatGraph& flat, Graph& graph, std::vector<Problem>& problems) {
  Analysis(flat, graph, problems).run();
}

}  // namespace engine
