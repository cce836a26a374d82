// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/experiments.h"
#include "engine/base/problem.h"

namespace {

void add_graph(CLI::App* command, cli::GraphArguments& arguments, bool required = true) {
  CLI::Option* graph = command->add_option("graph", arguments.path, "A graph file (JSON)");
  if (required) graph->required();
  command->add_option("--set", arguments.sets, "A parameter of the graph or of a node: NAME=VALUE or NODE.PARAM=VALUE")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

cli::CommandTree tree_of(const CLI::App& app) {
  cli::CommandTree tree{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    cli::CommandTree::Option known;
    for (const std::string& name : option->get_snames()) known.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) known.names.push_back("--" + name);
    if (known.names.empty()) continue;  // a word without a name: a graph file
    known.doc = option->get_description();
    if (option->get_items_expected_max() > 0 && option->get_type_size_max() > 0) known.value = option->get_type_name();
    tree.options.push_back(std::move(known));
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    tree.commands.push_back(tree_of(*command));
  return tree;
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

// What was typed that cannot be understood, and the nearest word that can.
std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& error, const cli::Common& common) {
  const CLI::App* command = &app;
  std::string typed = "";  // "cache gc: "
  std::vector<std::string> options;
  const auto add_options = [&] {
    for (const cli::CommandTree::Option& option : tree_of(*command).options)
      options.insert(options.end(), option.names.begin(), option.names.end());
  };
  for (add_options(); !command->get_subcommands().empty(); add_options()) {
    command = command->get_subcommands()[0];
    typed += (typed.empty() ? "" : " ") + command->get_name();
  }
  if (!typed.empty()) typed += ": ";
  std::vector<std::string> commands = commands_of(*command);

  const std::vector<std::string> rest = app.remaining(true);
  const auto is_option = [](const std::string& text) { return text.starts_with("-"); };
  const auto word = std::find_if_not(rest.begin(), rest.end(), is_option);
  if (!commands.empty() && word != rest.end()) {
    if (command == &app)
      for (const cli::PluginCommand& other : cli::plugin_commands(common)) commands.push_back(other.name);
    return typed + "there is no command '" + *word + "'" + engine::did_you_mean(*word, commands);
  }
  if (const auto option = std::find_if(rest.begin(), rest.end(), is_option); option != rest.end())
    return typed + "there is no option '" + *option + "'" + engine::did_you_mean(*option, options);
  if (!commands.empty()) return typed + "expected one of the commands " + engine::listed(commands, "or");
  return typed + (word == rest.end() ? error.what() : "found a word too much: '" + *word + "'");
}

}  // namespace

int main(int count, char** words) {
  // Large values come and go: their memory shall go back to the system.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);

  CLI::App app{"Facegraph: runs a graph of nodes, and of it only what has changed."};
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default(false);
  cli::Common common;
  app.add_option("--plugins", common.plugin_folders, "Further folders of plugins")
      ->type_name("FOLDER")
      ->allow_extra_args(false);
  app.add_option("--store", common.store, "Where results are kept (default: FACEGRAPH_STORE, else the user's cache)")
      ->type_name("FOLDER");
  app.add_option("--store-limit", common.store_limit,
                 "What it may hold after a run, such as 100GB (default: FACEGRAPH_STORE_LIMIT, else 50GB)")
      ->type_name("SIZE");
  app.fallthrough();
  app.footer([&] { return cli::plugin_commands_help(common); });

  cli::RunArguments run;
  CLI::App* run_command = app.add_subcommand("run", "Run a graph and publish its outputs");
  add_graph(run_command, run.graph);
  run_command->add_option("--out", run.out, "Folder for the outputs")->type_name("FOLDER");
  run_command->add_option("--to", run.to, "Run only what this node needs, and publish nothing")->type_name("NODE");
  run_command->add_option("--elements", run.elements, "With --to: only these elements, such as 0-49")
      ->delimiter(',')
      ->type_name("IDS");
  run_command->add_option("--threads", run.threads, "Tasks at once (default: as many as cores)")
      ->check(CLI::Range(1, 1024));
  run_command->add_option("--memory", run.memory, "Budget for values in memory, such as 500MB")->type_name("SIZE");
  run_command->add_flag("--fail-fast", run.fail_fast, "Stop at the first failed task");
  run_command->add_flag("--quiet", run.quiet, "Print failures only");
  run_command->add_option("--events", run.events, "Write events as NDJSON to a file (- = standard output)")
      ->type_name("FILE");
  run_command->add_option("--trace", run.trace, "Write a trace to a file that Perfetto and chrome://tracing open")
      ->type_name("FILE");
  run_command->add_option("--summary", run.summary, "Write counts and time as JSON to a file")->type_name("FILE");

  cli::PlanArguments plan;
  CLI::App* plan_command = app.add_subcommand("plan", "Say what a run would do");
  add_graph(plan_command, plan.graph);
  plan_command->add_flag("--all", plan.all, "List cached tasks too");
  plan_command->add_flag("--json", plan.json, "As JSON");

  cli::ExplainArguments explain;
  CLI::App* explain_command = app.add_subcommand("explain", "Say why a node would run again: the true first cause");
  add_graph(explain_command, explain.graph);
  explain_command->add_option("task", explain.task, "NODE, or NODE[ID]")->required();
  explain_command->add_flag("--json", explain.json, "As JSON");

  cli::GetArguments get;
  CLI::App* get_command = app.add_subcommand("get", "Look at one value inside a graph");
  add_graph(get_command, get.graph);
  get_command->add_option("value", get.reference, "NODE.OUTPUT[ID]")->required();
  get_command->add_option("-o,--output", get.out, "File to write, such as x.png (default: JSON on standard output)")
      ->type_name("FILE");

  cli::GraphArguments validate;
  CLI::App* validate_command = app.add_subcommand("validate", "Check a graph and run nothing");
  add_graph(validate_command, validate);

  cli::NodesArguments nodes;
  CLI::App* nodes_command = app.add_subcommand("nodes", "List the nodes");
  nodes_command->add_option("filter", nodes.filter, "Only names and texts with this in them");
  nodes_command->add_flag("--json", nodes.json, "As JSON");
  nodes_command->add_flag("--markdown", nodes.markdown, "The reference page of all nodes");

  cli::DescribeArguments describe;
  CLI::App* describe_command = app.add_subcommand("describe", "Say everything about a node or a value type");
  describe_command->add_option("name", describe.name, "A node, such as seq.every, or a type")->required();
  describe_command->add_flag("--json", describe.json, "As JSON");

  CLI::App* schema_command = app.add_subcommand("schema", "Print the JSON Schema of graphs, with every installed node");

  cli::CacheArguments cache;
  CLI::App* cache_command = app.add_subcommand("cache", "The store of results");
  cache_command->require_subcommand(1);
  CLI::App* cache_stat = cache_command->add_subcommand("stat", "How much it holds");
  CLI::App* cache_gc = cache_command->add_subcommand("gc", "Remove what was not used for longest");
  cache_gc->add_option("--max-size", cache.max_size, "Keep at most this much (default: the store's limit)")
      ->type_name("SIZE");
  cache_gc->add_option("--max-age-days", cache.max_age_days, "Remove what is older")->check(CLI::PositiveNumber);
  CLI::App* cache_pin = cache_command->add_subcommand("pin", "Keep what a graph's results need, whatever gc removes");
  cache_pin->add_option("name", cache.name, "A name for the pin")->required();
  add_graph(cache_pin, cache.graph);
  CLI::App* cache_unpin = cache_command->add_subcommand("unpin", "Let a pin go");
  cache_unpin->add_option("name", cache.name, "The pin")->required();
  CLI::App* cache_verify = cache_command->add_subcommand("verify", "Check every object against its digest");
  CLI::App* cache_audit =
      cache_command->add_subcommand("audit", "Run a sample of a graph's stored tasks again and compare");
  add_graph(cache_audit, cache.graph);
  cache_audit->add_option("--sample", cache.sample, "How many of them, such as 5% (the default)")->type_name("PERCENT");
  cache_audit->add_option("--seed", cache.seed, "Another seed, other tasks (default 1)");

  cli::SweepArguments sweep;
  CLI::App* sweep_command =
      app.add_subcommand("sweep", "Run a graph with many settings and compare numbers that come out");
  add_graph(sweep_command, sweep.graph);
  sweep_command
      ->add_option(
          "--vary", sweep.vary,
          "NODE.PARAM, PARAM, or NODE.node (the kind of node) and its values (default: the graph's sweep block)")
      ->type_name("NAME=VALUE,VALUE,...")
      ->allow_extra_args(false);
  sweep_command
      ->add_option("--metric", sweep.metrics,
                   "A number to compare: NODE.OUTPUT, or NODE.OUTPUT/PATH into its JSON; the first one sorts")
      ->type_name("NODE.OUTPUT")
      ->allow_extra_args(false);
  sweep_command->add_flag("--largest-first", sweep.largest_first, "The largest number is the best one");
  sweep_command->add_option("--out", sweep.out, "Folder for sweep.csv and sweep.json")->type_name("FOLDER");
  sweep_command->add_flag("--outputs", sweep.outputs, "Publish the graph's outputs of each variant there too");
  sweep_command->add_option("--threads", sweep.threads, "Tasks at once (default: as many as cores)")
      ->check(CLI::Range(1, 1024));
  sweep_command->add_option("--memory", sweep.memory, "Budget for values in memory, such as 500MB")->type_name("SIZE");
  sweep_command->add_flag("--quiet", sweep.quiet, "Print the table only");

  cli::GraphPictureArguments picture;
  CLI::App* picture_command = app.add_subcommand("graph", "Draw a graph");
  add_graph(picture_command, picture.graph);
  CLI::Option* svg = picture_command->add_flag("--svg", picture.svg, "As SVG, which any browser shows (the default)");
  picture_command->add_flag("--dot", picture.dot, "For Graphviz")->excludes(svg);
  picture_command->add_option("-o,--output", picture.out, "File to write (default: standard output)")
      ->type_name("FILE");

  cli::ReportArguments report;
  CLI::App* report_command = app.add_subcommand("report", "Run a graph and make a page of what it did");
  add_graph(report_command, report.graph);
  report_command->add_option("--out", report.out, "The page (default report.html)")->type_name("FILE");
  report_command->add_option("--threads", report.threads, "Tasks at once (default: as many as cores)")
      ->check(CLI::Range(1, 1024));
  report_command->add_flag("--quiet", report.quiet, "Print failures only");

  cli::CompareArguments compare;
  CLI::App* compare_command =
      app.add_subcommand("compare", "Say where two graphs, one with two settings, or two folders of results differ");
  compare_command->add_option("A", compare.a, "A graph file (JSON), or a folder or file that was made")->required();
  compare_command->add_option("B", compare.b, "Another (default: graph A again)");
  compare_command->add_option("--out", compare.out, "Make a page with pictures too")->type_name("FILE");
  compare_command->add_option("--set", compare.sets, "A parameter of both")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  compare_command->add_option("--set-a", compare.sets_a, "A parameter of A")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  compare_command->add_option("--set-b", compare.sets_b, "A parameter of B")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  compare_command->add_option("--threads", compare.threads, "Tasks at once (default: as many as cores)")
      ->check(CLI::Range(1, 1024));
  compare_command->add_flag("--all", compare.all, "Name every element that differs");
  compare_command->add_flag("--json", compare.json, "As JSON");
  compare_command->add_flag("--quiet", compare.quiet, "Show no progress");

  cli::NewArguments make_new;
  CLI::App* new_command = app.add_subcommand("new", "Copy starter graphs into a folder of your own");
  new_command->add_option("folder", make_new.folder, "A new folder");
  new_command->add_option("--from", make_new.from, "Which, as --list says; the beginning of a name is enough")
      ->type_name("NAME");
  new_command->add_flag("--list", make_new.list, "Say what there is");

  CLI::App* doctor_command = app.add_subcommand("doctor", "Look for what a run would stumble over");
  cli::DoctorArguments doctor;
  doctor_command->add_option("file", doctor.file, "A file or folder of your own to look at");
  doctor_command->add_option("--set", doctor.sets, "A parameter of what looks at it")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  doctor_command->add_option("--out", doctor.out, "Folder for what it writes (default: this one)")->type_name("FOLDER");

  std::string shell;
  CLI::App* completion_command = app.add_subcommand("completion", "Print a script that completes commands in a shell");
  completion_command->add_option("shell", shell, "bash or zsh")->required();

  try {
    int code = 0;
    if (cli::run_plugin_command({words + 1, words + count}, commands_of(app), code)) return code;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return cli::invalid;
  }
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    std::fprintf(stderr, "command line: %s\nRun with --help for more information.\n",
                 what_is_wrong(app, error, common).c_str());
    return cli::invalid;
  }
  try {
    if (*run_command) return cli::run(common, run);
    if (*plan_command) return cli::plan(common, plan);
    if (*explain_command) return cli::explain(common, explain);
    if (*get_command) return cli::get(common, get);
    if (*validate_command) return cli::validate(common, validate);
    if (*nodes_command) return cli::nodes(common, nodes);
    if (*describe_command) return cli::describe(common, describe);
    if (*schema_command) return cli::schema(common);
    if (*sweep_command) return cli::sweep(common, sweep);
    if (*picture_command) return cli::graph_picture(common, picture);
    if (*report_command) return cli::report(common, report);
    if (*compare_command) return cli::compare(common, compare);
    if (*new_command) return cli::make_new(common, make_new);
    if (*doctor_command) return cli::doctor(common, doctor);
    if (*completion_command) {
      std::printf("%s", cli::completion_script(tree_of(app), shell).c_str());
      return cli::done;
    }
    for (CLI::App* action : {cache_stat, cache_gc, cache_pin, cache_unpin, cache_verify, cache_audit})
      if (*action) cache.action = action->get_name();
    return cli::cache(common, cache);
  } catch (const engine::PluginError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return cli::plugin_problem;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return cli::invalid;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return cli::task_failed;
  }
}
