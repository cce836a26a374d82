// SPDX-License-Identifier: Apache-2.0
#include "engine/run/sweep.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <stdexcept>

#include "cli/commands.h"
#include "cli/experiments.h"
#include "cli/interrupt.h"
#include "cli/progress.h"

namespace cli {
namespace {

using engine::SweepSettings;
using engine::Variant;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_variants = 10000;

[[noreturn]] void refuse(const std::string& text) { throw std::invalid_argument("command line: " + text); }

// "smooth.lambda=1,10,100"; commas inside brackets belong to a value.
SweepSettings::Vary variation_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) refuse("--vary " + text + ": expected NAME=VALUE,VALUE,...");
  SweepSettings::Vary vary;
  vary.name = text.substr(0, equals);
  vary.values.emplace_back();
  int depth = 0;
  for (const char c : text.substr(equals + 1)) {
    depth += (c == '[') - (c == ']');
    if (c == ',' && depth == 0)
      vary.values.emplace_back();
    else
      vary.values.back() += c;
  }
  for (const std::string& value : vary.values)
    if (value.empty()) refuse("--vary " + text + ": a value is empty");
  vary.shown = vary.values;
  return vary;
}

struct Experiment {
  std::vector<SweepSettings::Vary> vary;
  std::vector<std::string> metric_names;
  std::vector<engine::Metric> metrics;
};

Experiment experiment_of(const SweepArguments& arguments, const SweepSettings& block) {
  Experiment experiment;
  experiment.vary = block.vary;
  if (!arguments.vary.empty()) experiment.vary.clear();
  for (const std::string& text : arguments.vary) experiment.vary.push_back(variation_of(text));
  if (experiment.vary.empty())
    refuse("nothing is varied: give --vary NAME=VALUE,VALUE,..., or the graph a \"sweep\" block");
  std::set<std::string> names;
  for (const std::string& set : arguments.graph.sets) names.insert(set.substr(0, set.find('=')));
  std::size_t count = 1;
  for (const auto& vary : experiment.vary) {
    if (!names.insert(vary.name).second) refuse(vary.name + " is varied, and given another time");
    count *= vary.values.size();
    if (count > most_variants) refuse("there are more than " + std::to_string(most_variants) + " combinations");
  }
  experiment.metric_names = arguments.metrics.empty() ? block.metrics : arguments.metrics;
  if (experiment.metric_names.empty() && !arguments.outputs)
    refuse("there is nothing to compare: give --metric NODE.OUTPUT, or --outputs to publish what each variant makes");
  for (const std::string& name : experiment.metric_names) {
    std::string error;
    if (!engine::parse_metric(name, experiment.metrics.emplace_back(), error))
      refuse("--metric " + name + ": " + error);
  }
  return experiment;
}

// What is varied was typed after --vary, not after --set.
std::string line_of(engine::Problem problem, const Experiment& experiment) {
  for (const auto& vary : experiment.vary)
    if (problem.place.pointer == "--set " + vary.name) problem.place.pointer = "--vary " + vary.name;
  return problem.line();
}

std::string shown_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

// Rows, the best one first; those that failed last, as they were tried.
std::vector<std::size_t> order_of(const std::vector<Variant>& variants, bool largest_first) {
  std::vector<std::size_t> order(variants.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto& x = variants[a].values;
    const auto& y = variants[b].values;
    if (x.empty() || y.empty()) return !x.empty() && y.empty();
    return largest_first ? x[0] > y[0] : x[0] < y[0];
  });
  return order;
}

class Results {
 public:
  Results(const Experiment& experiment, const std::vector<Variant>& variants,
          const std::vector<std::vector<std::string>>& shown, const std::vector<std::string>& folders)
      : experiment_(experiment), variants_(variants), shown_(shown), folders_(folders) {
    for (std::size_t i = 0; i < experiment.vary.size(); ++i)
      if (experiment.vary[i].values.size() > 1) differs_.push_back(i);
  }

  std::string table(const std::vector<std::size_t>& order) const {
    std::vector<std::vector<std::string>> rows(1);
    for (const std::size_t i : differs_) rows[0].push_back(experiment_.vary[i].name);
    for (const std::string& name : experiment_.metric_names) rows[0].push_back(name);
    const std::size_t numbers_from = differs_.size();
    for (const std::size_t v : order) {
      auto& row = rows.emplace_back();
      for (const std::size_t i : differs_) row.push_back(shown_[v][i]);
      for (const double value : variants_[v].values) row.push_back(shown_number(value));
      if (!variants_[v].failure.empty()) row.push_back("failed: " + variants_[v].failure);
    }
    std::vector<std::size_t> widths(rows[0].size(), 0);
    for (const auto& row : rows)
      for (std::size_t c = 0; c < widths.size() && c < row.size(); ++c)
        if (!row[c].starts_with("failed: ")) widths[c] = std::max(widths[c], row[c].size());
    std::string text;
    for (const auto& row : rows) {
      std::string line;
      for (std::size_t c = 0; c < row.size(); ++c) {
        const std::size_t room = c < widths.size() && widths[c] > row[c].size() ? widths[c] - row[c].size() : 0;
        if (c > 0) line += "  ";
        const bool right = c >= numbers_from && !row[c].starts_with("failed: ");
        line += right ? std::string(room, ' ') + row[c] : row[c] + std::string(room, ' ');
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
    return text;
  }

  std::string csv(const std::vector<std::size_t>& order) const {
    std::string text = "variant";
    for (const std::size_t i : differs_) text += "," + csv_cell(experiment_.vary[i].name);
    for (const std::string& name : experiment_.metric_names) text += "," + csv_cell(name);
    text += ",failure\n";
    for (const std::size_t v : order) {
      text += std::to_string(v + 1);
      for (const std::size_t i : differs_) text += "," + csv_cell(shown_[v][i]);
      for (std::size_t m = 0; m < experiment_.metric_names.size(); ++m)
        text += "," + (variants_[v].values.empty() ? "" : engine::to_text(variants_[v].values[m]));
      text += "," + csv_cell(variants_[v].failure) + "\n";
    }
    return text;
  }

  std::string json(const std::vector<std::size_t>& order, const SweepArguments& arguments,
                   const engine::SweepResult& result) const {
    Json rows = Json::array();
    for (const std::size_t v : order) {
      const Variant& variant = variants_[v];
      Json row = {{"variant", v + 1}, {"settings", Json::object()}};
      for (std::size_t i = 0; i < experiment_.vary.size(); ++i)
        row["settings"][experiment_.vary[i].name] = shown_[v][i];
      row["metrics"] = Json::object();
      for (std::size_t m = 0; m < variant.values.size(); ++m)
        row["metrics"][experiment_.metric_names[m]] = variant.values[m];
      if (!variant.failure.empty()) row["failure"] = variant.failure;
      if (!variant.graph.notes.empty()) row["notes"] = variant.graph.notes;
      if (!folders_.empty()) row["folder"] = folders_[v];
      row["tasks"] = {{"run", variant.run}, {"reused", variant.reused}};
      row["seconds"] = variant.seconds;
      rows.push_back(std::move(row));
    }
    const Json all = {{"graph", arguments.graph.path},
                      {"set", arguments.graph.sets},
                      {"metrics", experiment_.metric_names},
                      {"variants", rows},
                      {"tasks",
                       {{"run", result.tasks.run},
                        {"reused", result.tasks.reused},
                        {"failed", result.tasks.failed},
                        {"blocked", result.tasks.blocked}}},
                      {"seconds", result.seconds}};
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }

 private:
  const Experiment& experiment_;
  const std::vector<Variant>& variants_;
  const std::vector<std::vector<std::string>>& shown_;
  const std::vector<std::string>& folders_;
  std::vector<std::size_t> differs_;
};

std::vector<Variant> variants_of(const Experiment& experiment, const SweepArguments& arguments,
                                 const engine::Plugins& plugins) {
  std::vector<Variant> variants;
  for (const auto& settings : engine::combinations(experiment.vary)) {
    Variant& variant = variants.emplace_back();
    variant.settings = settings;
    std::vector<engine::Setting> all = settings_of(arguments.graph.sets);
    all.insert(all.end(), settings.begin(), settings.end());
    engine::GraphReading reading = read_graph(arguments.graph.path, all, plugins);
    variant.graph = std::move(reading.graph);
    variant.problems = std::move(reading.problems);
  }
  return variants;
}

// The values of every variant, as they were written.
std::vector<std::vector<std::string>> shown_values(const Experiment& experiment) {
  std::vector<SweepSettings::Vary> as_written = experiment.vary;
  for (auto& vary : as_written) vary.values = vary.shown;
  std::vector<std::vector<std::string>> shown;
  for (const auto& settings : engine::combinations(as_written)) {
    auto& row = shown.emplace_back();
    for (const engine::Setting& setting : settings) row.push_back(setting.value);
  }
  return shown;
}

// Throws for a metric that no variant has.
void check_metrics(const Experiment& experiment, const std::vector<Variant>& variants) {
  for (std::size_t m = 0; m < experiment.metrics.size(); ++m) {
    const engine::Reference& reference = experiment.metrics[m].reference;
    std::vector<std::string> nodes, outputs;  // of all variants: their kinds may differ
    bool node_known = false, output_known = reference.output.empty();
    for (const Variant& variant : variants)
      for (const engine::GraphNode& node : variant.graph.nodes) {
        nodes.push_back(node.id);
        if (node.id != reference.node) continue;
        node_known = true;
        output_known |= node.info->find_output(reference.output) >= 0;
        for (const engine::OutputInfo& output : node.info->outputs)
          if (std::find(outputs.begin(), outputs.end(), output.name) == outputs.end()) outputs.push_back(output.name);
      }
    const std::string start = "--metric " + experiment.metric_names[m] + ": ";
    if (!node_known)
      refuse(start + "the graph has no node '" + reference.node + "'" + engine::did_you_mean(reference.node, nodes));
    if (!output_known)
      refuse(start + "node '" + reference.node + "' has no output '" + reference.output + "'" +
             engine::did_you_mean_of(reference.output, outputs));
  }
}

void publish_outputs(Variant& variant, const engine::RunOptions& options, engine::Plugins& plugins,
                     engine::Store& store, engine::SweepResult& result) {
  engine::Graph graph = variant.graph;
  graph.path += "#sweep";
  const engine::RunResult ran = engine::run_graph(graph, plugins, store, options);
  result.tasks.run += ran.tasks.run;
  result.seconds += ran.seconds;
  if (variant.failure.empty() && !ran.failures.empty()) variant.failure = ran.failures.front();
}

}  // namespace

int sweep(const Common& common, const SweepArguments& arguments) {
  catch_interrupts();
  const auto plugins = open_plugins(common);
  const engine::GraphReading base = read_graph(arguments.graph.path, settings_of(arguments.graph.sets), *plugins);
  const Experiment experiment = experiment_of(arguments, base.graph.sweep);
  if (arguments.outputs && arguments.out.empty()) refuse("--outputs goes with --out FOLDER");

  std::vector<Variant> variants = variants_of(experiment, arguments, *plugins);
  // What is wrong with every variant is wrong with the graph, or with what was typed.
  if (std::all_of(variants.begin(), variants.end(), [](const Variant& variant) { return !variant.problems.empty(); })) {
    for (const engine::Problem& problem : variants[0].problems)
      std::fprintf(stderr, "%s\n", line_of(problem, experiment).c_str());
    std::fprintf(stderr, "none of the %zu variants is a valid graph; nothing was run\n", variants.size());
    return invalid;
  }
  check_metrics(experiment, variants);
  std::set<std::string> notes;
  for (Variant& variant : variants) {
    for (engine::Problem& problem : variant.problems) problem = {{}, line_of(problem, experiment)};
    for (const std::string& note : variant.graph.notes)
      if (notes.insert(note).second) std::fprintf(stderr, "note: %s\n", note.c_str());
  }

  const auto store = open_store(common);
  ProgressPrinter progress(arguments.quiet);
  engine::RunOptions options;
  options.threads = arguments.threads;
  if (!arguments.memory.empty()) options.memory_bytes = size_of("--memory", arguments.memory);
  options.observer = [&](const engine::RunEvent& event) { progress.show(event); };
  stop_on_interrupt(options);
  engine::SweepResult result = engine::run_sweep(variants, experiment.metrics, *plugins, *store, options);
  progress.finish();

  std::vector<std::string> folders;  // of the variants' outputs, where they are published
  for (std::size_t v = 0; v < variants.size() && arguments.outputs && !interrupt_requested(); ++v) {
    folders.push_back("variant" + std::to_string(v + 1));
    engine::RunOptions publish = options;
    publish.out_folder = (std::filesystem::path(arguments.out) / folders.back()).string();
    if (variants[v].problems.empty()) publish_outputs(variants[v], publish, *plugins, *store, result);
    progress.finish();
  }

  const std::vector<std::size_t> order = order_of(variants, arguments.largest_first);
  const std::vector<std::vector<std::string>> shown = shown_values(experiment);
  const Results results(experiment, variants, shown, folders);
  if (!arguments.out.empty() && (folders.empty() || folders.size() == variants.size())) {
    const std::filesystem::path out = arguments.out;
    write_whole((out / "sweep.csv").string(), results.csv(order));
    write_whole((out / "sweep.json").string(), results.json(order, arguments, result));
  }
  if (interrupt_requested()) {
    std::fprintf(stderr, "interrupted: %zu finished tasks are kept\n", result.tasks.run);
    return interrupted;
  }
  std::printf("%s", results.table(order).c_str());
  const auto failed =
      std::count_if(variants.begin(), variants.end(), [](const Variant& variant) { return !variant.failure.empty(); });
  if (!arguments.quiet)
    std::fprintf(stderr, "%zu variants, %td failed; %zu tasks run, %zu reused in %.2f s\n", variants.size(), failed,
                 result.tasks.run, result.tasks.reused, result.seconds);
  return failed > 0 ? task_failed : done;
}

}  // namespace cli
