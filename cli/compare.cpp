// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "cli/commands.h"
#include "cli/differences.h"
#include "cli/experiments.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "engine/describe/picture.h"
#include "engine/run/inspect.h"
#include "engine/run/run.h"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;
using engine::escape_markup;
namespace fs = std::filesystem;

struct Side {
  engine::Graph graph;
  std::vector<engine::StoredNode> stored;
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

// One node of both graphs, or one file of both folders.
struct Entry {
  Json json;
  std::vector<std::pair<std::string, std::string>> shown;  // name of an output, and what a page shows of it
};

void print_difference(const std::string& name, const Json& d) {
  std::printf("  %s: %s\n", name.c_str(), line_of(d).c_str());
  if (d.contains("elements")) {
    std::string list;
    for (const Json& element : d["elements"]) list += " " + element.get<std::string>();
    if (list != " ") std::printf("    %s\n", list.substr(1).c_str());
  }
}

void print_entry(const Json& entry) {
  const std::string id = entry["node"];
  if (entry.contains("only_in")) {
    std::printf("%s: only in %s%s\n", id.c_str(), entry["only_in"].get<std::string>().c_str(),
                entry.contains("kind") ? (" (" + entry["kind"].get<std::string>() + ")").c_str() : "");
    return;
  }
  std::printf("%s\n", id.c_str());
  for (const Json& change : entry.value("changes", Json::array()))
    std::printf("  %s: %s -> %s\n", change["what"].get<std::string>().c_str(),
                shortened(change["a"].get<std::string>()).c_str(), shortened(change["b"].get<std::string>()).c_str());
  if (entry.contains("results"))
    for (const auto& [name, difference] : entry["results"].items()) print_difference(name, difference);
}

std::string html_of(const Entry& entry) {
  const Json& json = entry.json;
  std::string html = "<section><h2>" + escape_markup(json["node"].get<std::string>()) + "</h2>";
  if (json.contains("only_in")) return html + "<p>only in " + json["only_in"].get<std::string>() + "</p></section>\n";
  if (json.contains("changes")) {
    html += "<div class=\"wide\"><table><tr><th></th><th>A</th><th>B</th></tr>";
    for (const Json& change : json["changes"])
      html += "<tr><th>" + escape_markup(change["what"].get<std::string>()) + "</th><td>" +
              escape_markup(change["a"].get<std::string>()) + "</td><td>" +
              escape_markup(change["b"].get<std::string>()) + "</td></tr>";
    html += "</table></div>";
  }
  if (json.contains("results"))
    for (const auto& [name, difference] : json["results"].items()) {
      html += "<h3>" + escape_markup(name) + "</h3><p>" + escape_markup(line_of(difference)) + "</p>";
      for (const auto& [output, shown] : entry.shown)
        if (output == name) html += shown;
    }
  return html + "</section>\n";
}

// Prints, writes the page, and says by the exit code whether all was run.
int finish(const CompareArguments& arguments, const std::vector<Entry>& entries, std::size_t equal, const char* what,
           const std::vector<std::string>& failures) {
  const std::string b = arguments.b.empty() ? arguments.a : arguments.b;
  const std::string same = std::to_string(equal) + " " + what + (equal == 1 ? " is" : "s are") + " the same in both";
  if (arguments.json) {
    Json nodes = Json::array();
    for (const Entry& entry : entries) nodes.push_back(entry.json);
    const Json all = {{"a", arguments.a},
                      {"b", b},
                      {std::string("equal_") + what + "s", equal},
                      {std::string(what) + "s", nodes},
                      {"failures", failures}};
    std::printf("%s\n", all.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  } else {
    for (const Entry& entry : entries) print_entry(entry.json);
    std::printf("%s\n", same.c_str());
  }
  for (const std::string& failure : failures) std::fprintf(stderr, "failed: %s\n", failure.c_str());
  if (!arguments.out.empty()) {
    std::string body = "<h1>A: " + escape_markup(arguments.a) + "<br>B: " + escape_markup(b) + "</h1>\n";
    for (const auto* sets : {&arguments.sets, &arguments.sets_a, &arguments.sets_b})
      for (const std::string& set : *sets)
        body += "<p class=\"dim\">" +
                std::string(sets == &arguments.sets     ? "both"
                            : sets == &arguments.sets_a ? "A"
                                                        : "B") +
                ": " + escape_markup(set) + "</p>";
    for (const std::string& failure : failures) body += "<p class=\"bad\">" + escape_markup(failure) + "</p>";
    body += "<p>" + same + "</p>\n";
    for (const Entry& entry : entries) body += html_of(entry);
    write_whole(arguments.out, html_page("Compare", body));
    if (!arguments.quiet) std::fprintf(stderr, "%s\n", arguments.out.c_str());
  }
  return failures.empty() ? done : task_failed;
}

// Files below a folder by their relative path; a file by its own name, the same for both.
std::map<std::string, fs::path> files_of(const fs::path& path) {
  std::map<std::string, fs::path> files;
  if (!fs::is_directory(path)) return {{"", path}};
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) files.emplace(entry.path().lexically_relative(path).string(), entry.path());
  return files;
}

int compare_outputs(const Common& common, const CompareArguments& arguments) {
  if (!arguments.sets.empty() || !arguments.sets_a.empty() || !arguments.sets_b.empty())
    throw std::invalid_argument("command line: --set goes with graphs; " + arguments.a + " is a file or a folder");
  if (fs::is_directory(arguments.a) != fs::is_directory(arguments.b))
    throw std::invalid_argument("command line: " + arguments.a + " and " + arguments.b +
                                ": expected two folders or two files");
  const auto plugins = open_plugins(common);
  const auto store = open_store(common);
  Differences differences(*plugins, *store, plugin_folders(common), arguments.all);
  const auto a = files_of(arguments.a), b = files_of(arguments.b);
  std::vector<Entry> entries;
  std::size_t equal = 0;
  for (const auto& [name, path] : a) {
    const std::string title = name.empty() ? path.filename().string() : name;
    const auto other = b.find(name);
    if (other == b.end()) {
      entries.push_back({{{"node", title}, {"only_in", "A"}}, {}});
      continue;
    }
    if (interrupt_requested()) return interrupted;
    const Found found = differences.files(path.string(), other->second.string(), path.extension().string());
    if (!found.json) {
      ++equal;
      continue;
    }
    entries.push_back({{{"node", title}, {"results", {{"content", *found.json}}}}, {{"content", found.html}}});
  }
  for (const auto& [name, path] : b)
    if (!a.contains(name)) entries.push_back({{{"node", name}, {"only_in", "B"}}, {}});
  return finish(arguments, entries, equal, "file", {});
}

// Whether a file is a graph: JSON that says so.
bool is_graph(const std::string& path) {
  if (fs::is_directory(path) || !path.ends_with(".json")) return false;
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return text.find("\"facegraph\"") != std::string::npos || text.find("\"extends\"") != std::string::npos;
}

// Runs one side. False where it was interrupted.
bool run_side(const char* name, engine::Plugins& plugins, engine::Store& store, const CompareArguments& arguments,
              ProgressPrinter& progress, std::vector<std::string>& failures, Side& side) {
  engine::RunOptions options;
  options.threads = arguments.threads;
  options.observer = [&](const engine::RunEvent& event) { progress.show(event); };
  stop_on_interrupt(options);
  const engine::RunResult result = engine::run_graph(side.graph, plugins, store, options);
  progress.finish();
  if (interrupt_requested()) {
    std::fprintf(stderr, "interrupted: finished tasks are kept\n");
    return false;
  }
  for (const std::string& failure : result.failures) failures.push_back(name + (": " + failure));
  side.stored = engine::inspect_graph(side.graph, plugins, store);
  return true;
}

// A node that both sides have, by its places in them. Nothing where they agree.
std::optional<Entry> compare_node(const Side& a, std::size_t n, const Side& b, std::size_t m,
                                  Differences& differences) {
  const engine::GraphNode &x = a.graph.nodes[n], &y = b.graph.nodes[m];
  const Json changes = changes_of(a.graph, x, b.graph, y);
  Json results = Json::object();
  std::vector<std::pair<std::string, std::string>> shown;
  for (std::size_t o = 0; o < x.info->outputs.size(); ++o) {
    const std::string& name = x.info->outputs[o].name;
    const int other = x.info->structural == engine::Structural::none ? y.info->find_output(name) : static_cast<int>(o);
    if (other < 0 || static_cast<std::size_t>(other) >= y.output_type.size()) continue;
    const auto p = static_cast<std::size_t>(other);
    if (x.output_type[o] != y.output_type[p]) {
      results[name] = {{"a", x.output_type[o]}, {"b", y.output_type[p]}, {"values", 1}};
      continue;
    }
    Found found = differences.outputs(x.output_type[o], a.stored[n].outputs[o], b.stored[m].outputs[p]);
    if (!found.json) continue;
    results[name] = *found.json;
    shown.emplace_back(name, std::move(found.html));
  }
  if (changes.empty() && results.empty()) return std::nullopt;
  Json entry = {{"node", x.id}};
  if (!changes.empty()) entry["changes"] = changes;
  if (!results.empty()) entry["results"] = results;
  return Entry{std::move(entry), std::move(shown)};
}

// The place of a node that is needed, by its id.
std::optional<std::size_t> needed_node(const engine::Graph& graph, const std::string& id) {
  const int n = graph.find_node(id);
  if (n < 0 || !graph.nodes[static_cast<std::size_t>(n)].needed) return std::nullopt;
  return static_cast<std::size_t>(n);
}

Entry lone_node(const engine::GraphNode& node, const char* side) {
  return {{{"node", node.id}, {"only_in", side}, {"kind", node.info->name}}, {}};
}

}  // namespace

int compare(const Common& common, const CompareArguments& arguments) {
  catch_interrupts();
  for (const std::string& path : {arguments.a, arguments.b})
    if (!path.empty() && !fs::exists(path)) throw std::invalid_argument("command line: " + path + " does not exist");
  if (!arguments.b.empty() && !is_graph(arguments.a) && !is_graph(arguments.b))
    return compare_outputs(common, arguments);
  const auto plugins = open_plugins(common);
  const auto store = open_store(common);
  Side a, b;
  GraphArguments graph_a{arguments.a, arguments.sets};
  GraphArguments graph_b{arguments.b.empty() ? arguments.a : arguments.b, arguments.sets};
  graph_a.sets.insert(graph_a.sets.end(), arguments.sets_a.begin(), arguments.sets_a.end());
  graph_b.sets.insert(graph_b.sets.end(), arguments.sets_b.begin(), arguments.sets_b.end());
  if (!read_graph(graph_a, *plugins, a.graph) || !read_graph(graph_b, *plugins, b.graph)) return invalid;
  if (arguments.b.empty() && arguments.sets_a.empty() && arguments.sets_b.empty()) {
    std::fprintf(stderr, "command line: there is nothing to compare: give a second graph, or --set-b NAME=VALUE\n");
    return invalid;
  }
  ProgressPrinter progress(arguments.quiet);
  std::vector<std::string> failures;
  if (!run_side("A", *plugins, *store, arguments, progress, failures, a) ||
      !run_side("B", *plugins, *store, arguments, progress, failures, b))
    return interrupted;

  Differences differences(*plugins, *store, plugin_folders(common), arguments.all);
  std::vector<Entry> entries;
  std::size_t equal = 0;
  for (std::size_t n = 0; n < a.graph.nodes.size(); ++n) {
    const engine::GraphNode& node = a.graph.nodes[n];
    if (!node.needed) continue;
    if (const auto m = needed_node(b.graph, node.id); !m)
      entries.push_back(lone_node(node, "A"));
    else if (std::optional<Entry> entry = compare_node(a, n, b, *m, differences))
      entries.push_back(std::move(*entry));
    else
      ++equal;
  }
  for (const engine::GraphNode& node : b.graph.nodes)
    if (node.needed && !needed_node(a.graph, node.id)) entries.push_back(lone_node(node, "B"));
  return finish(arguments, entries, equal, "node", failures);
}

}  // namespace cli
