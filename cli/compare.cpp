// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/experiments.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "engine/run/inspect.h"
#include "engine/run/run.h"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_bytes = 20'000'000;  // of a value that is compared number by number
constexpr std::size_t most_pairs = 500;         // of values of one output that are

std::string short_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// How two JSON forms differ, number by number.
struct Difference {
  std::size_t numbers = 0, differing = 0, others = 0;
  double largest = 0, squares = 0;
  std::string where;  // of the largest
  std::string a, b;   // of the first that is no number
  bool form = false;  // they are not made alike: lengths or keys differ

  void visit(const Json& x, const Json& y, const std::string& at) {
    if (x.is_number() && y.is_number()) {
      ++numbers;
      const double d = std::abs(x.get<double>() - y.get<double>());
      if (d > 0) ++differing;
      squares += d * d;
      if (d > largest) largest = d, where = at;
    } else if (x.is_object() && y.is_object()) {
      form |= x.size() != y.size();
      for (const auto& [key, value] : x.items())
        if (const auto other = y.find(key); other != y.end())
          visit(value, *other, at + "/" + key);
        else
          form = true;
    } else if (x.is_array() && y.is_array()) {
      form |= x.size() != y.size();
      for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) visit(x[i], y[i], at + "/" + std::to_string(i));
    } else if (x != y) {
      if (others++ == 0) a = x.dump(), b = y.dump();
      form |= x.type() != y.type();
    }
  }
};

std::string shortened(const std::string& text) { return text.size() <= 60 ? text : text.substr(0, 57) + "..."; }

struct Side {
  engine::Graph graph;
  std::vector<engine::StoredNode> stored;
  std::size_t failed = 0;
};

std::string source_text(const engine::Graph& graph, const engine::Source& source) {
  if (source.kind == engine::Source::Kind::none) return "nothing";
  if (source.kind == engine::Source::Kind::file) return source.shown_path;
  const engine::GraphNode& from = graph.nodes[static_cast<std::size_t>(source.node)];
  std::string text = from.id + "." + from.info->outputs[static_cast<std::size_t>(source.output)].name, element;
  for (const std::string& id : source.element) element += (element.empty() ? "" : "/") + id;
  return element.empty() ? text : text + "[" + element + "]";
}

std::string port_text(const engine::Graph& graph, const std::vector<engine::Source>& port) {
  std::string text;
  for (const engine::Source& source : port) text += (text.empty() ? "" : ", ") + source_text(graph, source);
  return text.empty() ? "nothing" : text;
}

std::string override_text(const engine::GraphNode& node) {
  std::string text;
  for (const engine::Override& override : node.overrides)
    for (const auto& [param, value] : override.params)
      text += (text.empty() ? "" : ", ") + override.text + ": " +
              node.info->params[static_cast<std::size_t>(param)].name + " " + engine::to_text(value);
  return text.empty() ? "none" : text;
}

// What is declared differently: {"what": ..., "a": ..., "b": ...}.
Json changes_of(const engine::Graph& a, const engine::GraphNode& x, const engine::Graph& b,
                const engine::GraphNode& y) {
  Json changes = Json::array();
  const auto add = [&](const std::string& what, const std::string& before, const std::string& after) {
    if (before != after) changes.push_back({{"what", what}, {"a", before}, {"b", after}});
  };
  add("kind", x.info->name, y.info->name);
  const auto value_of = [](const engine::GraphNode& node, const std::string& name) {
    const int param = node.info->find_param(name);
    return param < 0 ? std::string("absent") : engine::to_text(node.params[static_cast<std::size_t>(param)]);
  };
  for (const engine::ParamInfo& param : x.info->params)
    add(param.name, value_of(x, param.name), value_of(y, param.name));
  for (const engine::ParamInfo& param : y.info->params)
    if (x.info->find_param(param.name) < 0) add(param.name, "absent", value_of(y, param.name));
  for (std::size_t p = 0; p < x.inputs.size(); ++p) {
    const std::string& name = x.info->inputs[p].name;
    const int other = y.info->find_input(name);
    add("input " + name, port_text(a, x.inputs[p]),
        other < 0 ? "absent" : port_text(b, y.inputs[static_cast<std::size_t>(other)]));
  }
  add("overrides", override_text(x), override_text(y));
  return changes;
}

// How the values of one output differ; null where they are equal.
Json difference_of(const std::string& type, const engine::StoredOutput& a, const engine::StoredOutput& b,
                   engine::Plugins& plugins, engine::Store& store, bool all) {
  std::map<std::string, engine::Digest> others;
  for (const engine::StoredLeaf& leaf : b.leaves) others.emplace(leaf.element, leaf.identity);
  Json result = {{"values", a.leaves.size()}};
  std::size_t equal = 0, only_a = 0, compared = 0, differing = 0;
  Difference worst;
  std::string worst_element;
  double squares = 0;
  std::size_t numbers = 0;
  Json elements = Json::array();
  for (const engine::StoredLeaf& leaf : a.leaves) {
    const auto other = others.find(leaf.element);
    if (other == others.end()) {
      ++only_a;
      continue;
    }
    const engine::Digest identity = other->second;
    others.erase(other);
    if (identity == leaf.identity) {
      ++equal;
      continue;
    }
    ++differing;
    if (all) elements.push_back(leaf.element);
    if (compared >= most_pairs || type == "file" || a.cheap || b.cheap) continue;
    const auto x = engine::stored_value(type, leaf.identity, plugins, store);
    const auto y = engine::stored_value(type, identity, plugins, store);
    if (!x || !y || x->size_bytes() + y->size_bytes() > most_bytes) continue;
    Difference difference;
    difference.visit(Json::parse(x->type().show(x->data().get()), nullptr, false),
                     Json::parse(y->type().show(y->data().get()), nullptr, false), "");
    ++compared;
    squares += difference.squares;
    numbers += difference.numbers;
    if (a.leaves.size() == 1 && (type == "number" || type == "integer" || type == "flag" || type == "text")) {
      result["a"] = Json::parse(x->type().show(x->data().get()), nullptr, false);
      result["b"] = Json::parse(y->type().show(y->data().get()), nullptr, false);
    }
    const bool form = worst.form || difference.form;
    const std::size_t texts = worst.others + difference.others;
    if (compared == 1 || difference.largest > worst.largest) worst = difference, worst_element = leaf.element;
    worst.form = form;
    worst.others = texts;
  }
  if (differing + only_a + others.size() == 0) return nullptr;
  result["equal"] = equal;
  result["differing"] = differing;
  if (only_a > 0) result["only_in_a"] = only_a;
  if (!others.empty()) result["only_in_b"] = others.size();
  if (compared > 0 && numbers > 0) {
    result["compared"] = compared;
    result["largest_difference"] = worst.largest;
    result["largest_at"] = (worst_element.empty() ? "" : "[" + worst_element + "]") + worst.where;
    result["rms_difference"] = std::sqrt(squares / static_cast<double>(numbers));
  }
  if (compared > 0 && worst.form) result["form_differs"] = true;
  if (compared > 0 && worst.others > 0) result["texts_differing"] = worst.others;
  if (all && !elements.empty()) result["elements"] = elements;
  return result;
}

void print_difference(const std::string& name, const Json& d) {
  std::string text = "  " + name + ": ";
  const auto count = [&](const char* key) { return d.value(key, std::size_t{0}); };
  if (d.contains("a"))
    text += shortened(d["a"].dump()) + " -> " + shortened(d["b"].dump());
  else if (count("values") == 1 && count("differing") == 1)
    text += "differs";
  else
    text += std::to_string(count("differing")) + " of " + std::to_string(count("values")) + " values differ";
  if (count("only_in_a") > 0) text += ", " + std::to_string(count("only_in_a")) + " only in A";
  if (count("only_in_b") > 0) text += ", " + std::to_string(count("only_in_b")) + " only in B";
  if (d.contains("largest_difference")) {
    const std::string at = d["largest_at"];
    text += "; by at most " + short_number(d["largest_difference"]) + (at.empty() ? "" : " at " + at);
    if (!d.contains("a")) text += ", rms " + short_number(d["rms_difference"]);
  }
  if (d.contains("form_differs")) text += "; they are not made alike";
  std::printf("%s\n", text.c_str());
  if (d.contains("elements")) {
    std::string list;
    for (const Json& element : d["elements"]) list += " " + element.get<std::string>();
    if (list != " ") std::printf("    %s\n", list.substr(1).c_str());
  }
}

}  // namespace

int compare(const Common& common, const CompareArguments& arguments) {
  catch_interrupts();
  const auto plugins = open_plugins(common);
  const auto store = open_store(common);
  Side sides[2];
  for (int s = 0; s < 2; ++s) {
    GraphArguments graph{s == 0 || arguments.b.empty() ? arguments.a : arguments.b, arguments.sets};
    const auto& own = s == 0 ? arguments.sets_a : arguments.sets_b;
    graph.sets.insert(graph.sets.end(), own.begin(), own.end());
    if (!read_graph(graph, *plugins, sides[s].graph)) return invalid;
  }
  if (arguments.b.empty() && arguments.sets_a.empty() && arguments.sets_b.empty()) {
    std::fprintf(stderr, "command line: there is nothing to compare: give a second graph, or --set-b NAME=VALUE\n");
    return invalid;
  }
  ProgressPrinter progress(arguments.quiet);
  std::vector<std::string> failures;
  for (int s = 0; s < 2; ++s) {
    engine::RunOptions options;
    options.threads = arguments.threads;
    options.observer = [&](const engine::RunEvent& event) { progress.show(event); };
    stop_on_interrupt(options);
    const engine::RunResult result = engine::run_graph(sides[s].graph, *plugins, *store, options);
    progress.clear();
    if (interrupt_requested()) {
      std::fprintf(stderr, "interrupted: finished tasks are kept\n");
      return interrupted;
    }
    for (const std::string& failure : result.failures) failures.push_back((s == 0 ? "A: " : "B: ") + failure);
    sides[s].stored = engine::inspect_graph(sides[s].graph, *plugins, *store);
  }

  Json nodes = Json::array();
  std::size_t equal = 0;
  const engine::Graph &a = sides[0].graph, &b = sides[1].graph;
  for (std::size_t n = 0; n < a.nodes.size(); ++n) {
    const engine::GraphNode& x = a.nodes[n];
    if (!x.needed) continue;
    const int m = b.find_node(x.id);
    if (m < 0 || !b.nodes[static_cast<std::size_t>(m)].needed) {
      nodes.push_back({{"node", x.id}, {"only_in", "A"}, {"kind", x.info->name}});
      continue;
    }
    const engine::GraphNode& y = b.nodes[static_cast<std::size_t>(m)];
    const Json changes = changes_of(a, x, b, y);
    Json results = Json::object();
    for (std::size_t o = 0; o < x.info->outputs.size(); ++o) {
      const std::string& name = x.info->outputs[o].name;
      const int other =
          x.info->structural == engine::Structural::none ? y.info->find_output(name) : static_cast<int>(o);
      if (other < 0 || static_cast<std::size_t>(other) >= y.output_type.size()) continue;
      const auto p = static_cast<std::size_t>(other);
      if (x.output_type[o] != y.output_type[p]) {
        results[name] = {{"a", x.output_type[o]}, {"b", y.output_type[p]}, {"values", 1}};
        continue;
      }
      const Json difference =
          difference_of(x.output_type[o], sides[0].stored[n].outputs[o],
                        sides[1].stored[static_cast<std::size_t>(m)].outputs[p], *plugins, *store, arguments.all);
      if (!difference.is_null()) results[name] = difference;
    }
    if (changes.empty() && results.empty()) {
      ++equal;
      continue;
    }
    Json entry = {{"node", x.id}};
    if (!changes.empty()) entry["changes"] = changes;
    if (!results.empty()) entry["results"] = results;
    nodes.push_back(std::move(entry));
  }
  for (const engine::GraphNode& y : b.nodes)
    if (const int n = a.find_node(y.id); y.needed && (n < 0 || !a.nodes[static_cast<std::size_t>(n)].needed))
      nodes.push_back({{"node", y.id}, {"only_in", "B"}, {"kind", y.info->name}});

  if (arguments.json) {
    const Json all = {{"a", arguments.a},
                      {"b", arguments.b.empty() ? arguments.a : arguments.b},
                      {"equal_nodes", equal},
                      {"nodes", nodes},
                      {"failures", failures}};
    std::printf("%s\n", all.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  } else {
    for (const Json& node : nodes) {
      const std::string id = node["node"];
      if (node.contains("only_in")) {
        std::printf("%s: only in %s (%s)\n", id.c_str(), node["only_in"].get<std::string>().c_str(),
                    node["kind"].get<std::string>().c_str());
        continue;
      }
      std::printf("%s\n", id.c_str());
      for (const Json& change : node.value("changes", Json::array()))
        std::printf("  %s: %s -> %s\n", change["what"].get<std::string>().c_str(),
                    shortened(change["a"].get<std::string>()).c_str(),
                    shortened(change["b"].get<std::string>()).c_str());
      if (node.contains("results"))
        for (const auto& [name, difference] : node["results"].items()) print_difference(name, difference);
    }
    std::printf("%zu node%s the same in both\n", equal, equal == 1 ? " is" : "s are");
  }
  for (const std::string& failure : failures) std::fprintf(stderr, "failed: %s\n", failure.c_str());
  return failures.empty() ? done : task_failed;
}

}  // namespace cli
