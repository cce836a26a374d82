// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"

namespace cli {
namespace {

// What can be typed, and what was.
struct CommandLine {
  CLI::App app{"Facegraph: runs a graph of nodes, and of it only what has changed."};
  Common common;
  std::function<int()> action;  // of the command that was typed, once the words are parsed
};

// A command that is being declared, and where its words go.
template <class Arguments>
struct Declared {
  CLI::App& command;
  Arguments& arguments;
};

template <class Arguments>
Declared<Arguments> add(CommandLine& line, const char* name, const char* doc,
                        int (*action)(const Common&, const Arguments&)) {
  CLI::App* const command = line.app.add_subcommand(name, doc);
  const auto arguments = std::make_shared<Arguments>();
  command->callback([&line, arguments, action] {
    line.action = [&line, arguments, action] { return action(line.common, *arguments); };
  });
  return {*command, *arguments};
}

void add_sets(CLI::App& command, const char* name, std::vector<std::string>& sets, const char* doc) {
  command.add_option(name, sets, doc)->type_name("NAME=VALUE")->allow_extra_args(false);
}

void add_graph(CLI::App& command, GraphArguments& arguments) {
  command.add_option("graph", arguments.path, "A graph file (JSON)")->required();
  add_sets(command, "--set", arguments.sets, "A parameter of the graph or of a node: NAME=VALUE or NODE.PARAM=VALUE");
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Tasks at once (default: as many as cores)")->check(CLI::Range(1, 1024));
}

void add_memory(CLI::App& command, std::string& memory) {
  command.add_option("--memory", memory, "Budget for values in memory, such as 500MB")->type_name("SIZE");
}

void add_json(CLI::App& command, bool& json) { command.add_flag("--json", json, "As JSON"); }

void add_common(CommandLine& line) {
  line.app.add_option("--plugins", line.common.plugin_folders, "Further folders of plugins")
      ->type_name("FOLDER")
      ->allow_extra_args(false);
  line.app
      .add_option("--store", line.common.store,
                  "Where results are kept (default: FACEGRAPH_STORE, else the user's cache)")
      ->type_name("FOLDER");
  line.app
      .add_option("--store-limit", line.common.store_limit,
                  "What it may hold after a run, such as 100GB (default: FACEGRAPH_STORE_LIMIT, else 50GB)")
      ->type_name("SIZE");
  line.app.footer([&line] { return plugin_commands_help(line.common); });
}

void add_run(CommandLine& line) {
  auto [command, arguments] = add(line, "run", "Run a graph and publish its outputs", &run);
  add_graph(command, arguments.graph);
  command.add_option("--out", arguments.out, "Folder for the outputs")->type_name("FOLDER");
  command.add_option("--to", arguments.to, "Run only what this node needs, and publish nothing")->type_name("NODE");
  command.add_option("--elements", arguments.elements, "With --to: only these elements, such as 0-49")
      ->delimiter(',')
      ->type_name("IDS");
  add_threads(command, arguments.threads);
  add_memory(command, arguments.memory);
  command.add_flag("--fail-fast", arguments.fail_fast, "Stop at the first failed task");
  command.add_flag("--quiet", arguments.quiet, "Print failures only");
  command.add_option("--events", arguments.events, "Write events as NDJSON to a file (- = standard output)")
      ->type_name("FILE");
  command.add_option("--trace", arguments.trace, "Write a trace to a file that Perfetto and chrome://tracing open")
      ->type_name("FILE");
  command.add_option("--summary", arguments.summary, "Write counts and time as JSON to a file")->type_name("FILE");
}

void add_plan(CommandLine& line) {
  auto [command, arguments] = add(line, "plan", "Say what a run would do", &plan);
  add_graph(command, arguments.graph);
  command.add_flag("--all", arguments.all, "List cached tasks too");
  add_json(command, arguments.json);
}

void add_explain(CommandLine& line) {
  auto [command, arguments] = add(line, "explain", "Say why a node would run again: the true first cause", &explain);
  add_graph(command, arguments.graph);
  command.add_option("task", arguments.task, "NODE, or NODE[ID]")->required();
  add_json(command, arguments.json);
}

void add_get(CommandLine& line) {
  auto [command, arguments] = add(line, "get", "Look at one value inside a graph", &get);
  add_graph(command, arguments.graph);
  command.add_option("value", arguments.reference, "NODE.OUTPUT[ID]")->required();
  command.add_option("-o,--output", arguments.out, "File to write, such as x.png (default: JSON on standard output)")
      ->type_name("FILE");
}

void add_validate(CommandLine& line) {
  auto [command, arguments] = add(line, "validate", "Check a graph and run nothing", &validate);
  add_graph(command, arguments);
}

void add_nodes(CommandLine& line) {
  auto [command, arguments] = add(line, "nodes", "List the nodes", &nodes);
  command.add_option("filter", arguments.filter, "Only names and texts with this in them");
  add_json(command, arguments.json);
  command.add_flag("--markdown", arguments.markdown, "The reference page of all nodes");
}

void add_describe(CommandLine& line) {
  auto [command, arguments] = add(line, "describe", "Say everything about a node or a value type", &describe);
  command.add_option("name", arguments.name, "A node, such as seq.every, or a type")->required();
  add_json(command, arguments.json);
}

void add_schema(CommandLine& line) {
  line.app.add_subcommand("schema", "Print the JSON Schema of graphs, with every installed node")->callback([&line] {
    line.action = [&line] { return schema(line.common); };
  });
}

void add_cache(CommandLine& line) {
  const Declared<CacheArguments> declared = add(line, "cache", "The store of results", &cache);
  declared.command.require_subcommand(1);
  CacheArguments& arguments = declared.arguments;
  const auto add_action = [&](const char* name, const char* doc) -> CLI::App& {
    CLI::App* const action = declared.command.add_subcommand(name, doc);
    action->callback([&arguments, name] { arguments.action = name; });
    return *action;
  };
  add_action("stat", "How much it holds");
  CLI::App& gc = add_action("gc", "Remove what was not used for longest");
  gc.add_option("--max-size", arguments.max_size, "Keep at most this much (default: the store's limit)")
      ->type_name("SIZE");
  gc.add_option("--max-age-days", arguments.max_age_days, "Remove what is older")->check(CLI::PositiveNumber);
  CLI::App& pin = add_action("pin", "Keep what a graph's results need, whatever gc removes");
  pin.add_option("name", arguments.name, "A name for the pin")->required();
  add_graph(pin, arguments.graph);
  add_action("unpin", "Let a pin go").add_option("name", arguments.name, "The pin")->required();
  add_action("verify", "Check every object against its digest");
  CLI::App& audit = add_action("audit", "Run a sample of a graph's stored tasks again and compare");
  add_graph(audit, arguments.graph);
  audit.add_option("--sample", arguments.sample, "How many of them, such as 5% (the default)")->type_name("PERCENT");
  audit.add_option("--seed", arguments.seed, "Another seed, other tasks (default 1)");
}

void add_sweep(CommandLine& line) {
  auto [command, arguments] =
      add(line, "sweep", "Run a graph with many settings and compare numbers that come out", &sweep);
  add_graph(command, arguments.graph);
  command
      .add_option(
          "--vary", arguments.vary,
          "NODE.PARAM, PARAM, or NODE.node (the kind of node) and its values (default: the graph's sweep block)")
      ->type_name("NAME=VALUE,VALUE,...")
      ->allow_extra_args(false);
  command
      .add_option("--metric", arguments.metrics,
                  "A number to compare: NODE.OUTPUT, or NODE.OUTPUT/PATH into its JSON; the first one sorts")
      ->type_name("NODE.OUTPUT")
      ->allow_extra_args(false);
  command.add_flag("--largest-first", arguments.largest_first, "The largest number is the best one");
  command.add_option("--out", arguments.out, "Folder for sweep.csv and sweep.json")->type_name("FOLDER");
  command.add_flag("--outputs", arguments.outputs, "Publish the graph's outputs of each variant there too");
  add_threads(command, arguments.threads);
  add_memory(command, arguments.memory);
  command.add_flag("--quiet", arguments.quiet, "Print the table only");
}

void add_graph_picture(CommandLine& line) {
  auto [command, arguments] = add(line, "graph", "Draw a graph", &graph_picture);
  add_graph(command, arguments.graph);
  CLI::Option* const svg = command.add_flag("--svg", arguments.svg, "As SVG, which any browser shows (the default)");
  command.add_flag("--dot", arguments.dot, "For Graphviz")->excludes(svg);
  command.add_option("-o,--output", arguments.out, "File to write (default: standard output)")->type_name("FILE");
}

void add_report(CommandLine& line) {
  auto [command, arguments] = add(line, "report", "Run a graph and make a page of what it did", &report);
  add_graph(command, arguments.graph);
  command.add_option("--out", arguments.out, "The page (default report.html)")->type_name("FILE");
  add_threads(command, arguments.threads);
  command.add_flag("--quiet", arguments.quiet, "Print failures only");
}

void add_compare(CommandLine& line) {
  auto [command, arguments] =
      add(line, "compare", "Say where two graphs, one with two settings, or two folders of results differ", &compare);
  command.add_option("A", arguments.a, "A graph file (JSON), or a folder or file that was made")->required();
  command.add_option("B", arguments.b, "Another (default: graph A again)");
  command.add_option("--out", arguments.out, "Make a page with pictures too")->type_name("FILE");
  add_sets(command, "--set", arguments.sets, "A parameter of both");
  add_sets(command, "--set-a", arguments.sets_a, "A parameter of A");
  add_sets(command, "--set-b", arguments.sets_b, "A parameter of B");
  add_threads(command, arguments.threads);
  command.add_flag("--all", arguments.all, "Name every element that differs");
  add_json(command, arguments.json);
  command.add_flag("--quiet", arguments.quiet, "Show no progress");
}

void add_new(CommandLine& line) {
  auto [command, arguments] = add(line, "new", "Copy starter graphs into a folder of your own", &make_new);
  command.add_option("folder", arguments.folder, "A new folder");
  command.add_option("--from", arguments.from, "Which, as --list says; the beginning of a name is enough")
      ->type_name("NAME");
  command.add_flag("--list", arguments.list, "Say what there is");
}

void add_doctor(CommandLine& line) {
  auto [command, arguments] = add(line, "doctor", "Look for what a run would stumble over", &doctor);
  command.add_option("file", arguments.file, "A file or folder of your own to look at");
  add_sets(command, "--set", arguments.sets, "A parameter of what looks at it");
  command.add_option("--out", arguments.out, "Folder for what it writes (default: this one)")->type_name("FOLDER");
}

// What was declared for a command, and for those inside it.
CommandTree tree_of(const CLI::App& command) {
  CommandTree tree{command.get_name(), command.get_description(), {}, {}};
  for (const CLI::Option* option : command.get_options()) {
    CommandTree::Option known;
    for (const std::string& name : option->get_snames()) known.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) known.names.push_back("--" + name);
    if (known.names.empty()) continue;  // a word without a name: a graph file
    known.doc = option->get_description();
    if (option->get_items_expected_max() > 0 && option->get_type_size_max() > 0) known.value = option->get_type_name();
    tree.options.push_back(std::move(known));
  }
  for (const CLI::App* inner : command.get_subcommands([](const CLI::App*) { return true; }))
    tree.commands.push_back(tree_of(*inner));
  return tree;
}

void add_completion(CommandLine& line) {
  CLI::App* const command = line.app.add_subcommand("completion", "Print a script that completes commands in a shell");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash or zsh")->required();
  command->callback([&line, shell] {
    line.action = [&line, shell] {
      std::printf("%s", completion_script(tree_of(line.app), *shell).c_str());
      return static_cast<int>(done);
    };
  });
}

void declare_commands(CommandLine& line) {
  line.app.require_subcommand(1);
  line.app.option_defaults()->always_capture_default(false);
  line.app.fallthrough();
  add_common(line);
  for (const auto declare :
       {add_run, add_plan, add_explain, add_get, add_validate, add_nodes, add_describe, add_schema, add_cache,
        add_sweep, add_graph_picture, add_report, add_compare, add_new, add_doctor, add_completion})
    declare(line);
}

// Which commands were typed, one inside the other.
std::vector<std::string> typed_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command = &app; !command->get_subcommands().empty();) {
    command = command->get_subcommands()[0];
    names.push_back(command->get_name());
  }
  return names;
}

}  // namespace

int run_command_line(int count, const char* const* words) {
  CommandLine line;
  declare_commands(line);
  const CommandTree tree = tree_of(line.app);
  std::vector<std::string> own;
  for (const CommandTree& command : tree.commands) own.push_back(command.name);
  int code = 0;
  if (run_plugin_command({words + 1, words + count}, own, code)) return code;
  try {
    line.app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return line.app.exit(error);  // --help
    const Mistyped mistyped{typed_commands(line.app), line.app.remaining(true), error.what()};
    std::fprintf(stderr, "command line: %s\nRun with --help for more information.\n",
                 what_is_wrong(tree, mistyped, line.common).c_str());
    return invalid;
  }
  return line.action();
}

}  // namespace cli
