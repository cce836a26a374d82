// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/experiments.h"
#include "cli/interrupt.h"
#include "cli/preview.h"
#include "cli/progress.h"
#include "engine/describe/describe.h"
#include "engine/describe/picture.h"
#include "engine/run/inspect.h"
#include "engine/run/run.h"

namespace cli {
namespace {

using engine::escape_markup;

// What a run did with a node.
struct Fate {
  std::size_t run = 0, reused = 0, failed = 0, blocked = 0;
  std::vector<std::string> failures;

  void see(const engine::RunEvent& event) {
    using Kind = engine::RunEvent::Kind;
    run += event.kind == Kind::finished;
    reused += event.kind == Kind::reused;
    failed += event.kind == Kind::failed;
    blocked += event.kind == Kind::blocked;
    if (event.kind == Kind::failed) failures.push_back(event.text);
  }
};

std::string seconds_text(double seconds) {
  char text[32];
  if (seconds < 0.0995)
    std::snprintf(text, sizeof text, "%.1f ms", seconds * 1000);
  else if (seconds < 600)
    std::snprintf(text, sizeof text, "%.1f s", seconds);
  else
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60);
  return text;
}

std::string anchor_of(const std::string& node) {
  std::string anchor = "node-";
  for (const char c : node) anchor += c == '/' ? '.' : c;
  return anchor;
}

std::string tasks_text(const Fate& fate) {
  std::string text;
  const auto add = [&](std::size_t count, const char* word) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + word;
  };
  add(fate.run, "run");
  add(fate.reused, "reused");
  add(fate.failed, "failed");
  add(fate.blocked, "blocked");
  return text;
}

std::string command_of(const GraphArguments& arguments) {
  std::string text = "facegraph run " + shell_word(arguments.path);
  for (const std::string& set : arguments.sets) text += " --set " + shell_word(set);
  return text + " --out out";
}

std::string list_of(const std::vector<std::string>& lines, const char* kind, std::size_t most = 20) {
  std::string html;
  for (std::size_t i = 0; i < lines.size() && i < most; ++i)
    html += std::string("<p class=\"") + kind + "\">" + escape_markup(lines[i]) + "</p>";
  if (lines.size() > most) html += "<p class=\"dim\">and " + std::to_string(lines.size() - most) + " more</p>";
  return html;
}

std::string params_of(const engine::GraphNode& node) {
  if (node.params.empty()) return {};
  std::string html = "<h3>Parameters</h3><div class=\"wide\"><table>";
  for (std::size_t p = 0; p < node.params.size(); ++p) {
    const engine::ParamInfo& info = node.info->params[p];
    const bool changed = node.params[p] != info.initial;
    html += std::string("<tr><th") + (changed ? " class=\"changed\"" : "") + ">" + escape_markup(info.name) +
            "</th><td" + (changed ? " class=\"changed\"" : "") + ">" + escape_markup(engine::to_text(node.params[p])) +
            (info.unit.empty() || info.unit == "1" ? "" : " " + escape_markup(info.unit)) + "</td><td class=\"dim\">" +
            escape_markup(info.doc) +
            (changed ? " (default " + escape_markup(engine::to_text(info.initial)) + ")" : "") + "</td></tr>";
  }
  for (const engine::Override& override : node.overrides)
    for (const auto& [param, value] : override.params)
      html += "<tr><th class=\"changed\">" + escape_markup(node.info->params[static_cast<std::size_t>(param)].name) +
              "</th><td class=\"changed\">" + escape_markup(engine::to_text(value)) + "</td><td class=\"dim\">of " +
              escape_markup(override.text) + "</td></tr>";
  return html + "</table></div>";
}

std::string inputs_of(const engine::Graph& graph, const engine::GraphNode& node) {
  std::string html;
  for (std::size_t p = 0; p < node.inputs.size(); ++p)
    for (const engine::Source& source : node.inputs[p]) {
      if (source.kind == engine::Source::Kind::none) continue;
      html += "<tr><th>" + escape_markup(node.info->inputs[p].name) + "</th><td>";
      if (source.kind == engine::Source::Kind::file) {
        html += escape_markup(source.shown_path);
      } else {
        const engine::GraphNode& from = graph.nodes[static_cast<std::size_t>(source.node)];
        std::string element;
        for (const std::string& id : source.element) element += (element.empty() ? "[" : "/") + id;
        html += "<a href=\"#" + escape_markup(anchor_of(from.id)) + "\">" + escape_markup(from.id) + "</a>." +
                escape_markup(from.info->outputs[static_cast<std::size_t>(source.output)].name + element +
                              (element.empty() ? "" : "]"));
      }
      html += "</td></tr>";
    }
  return html.empty() ? html : "<h3>Inputs</h3><div class=\"wide\"><table>" + html + "</table></div>";
}

struct Section {
  std::string html;
  engine::BoxNote note;  // on the picture of the graph
};

Section section_of(const engine::Graph& graph, const engine::GraphNode& node, const engine::StoredNode& record,
                   const Fate& fate, Previews& previews) {
  Section section;
  engine::BoxNote& note = section.note;
  note.link = "#" + anchor_of(node.id);
  const std::string tasks = tasks_text(fate);
  note.tone = fate.failed + fate.blocked > 0 ? "failed" : fate.run > 0 ? "run" : fate.reused > 0 ? "reused" : "";
  if (!tasks.empty()) note.lines.push_back(tasks);

  std::string& html = section.html;
  html = "<section id=\"" + escape_markup(anchor_of(node.id)) + "\"><h2>" + escape_markup(node.id) +
         " <span class=\"dim\">" + escape_markup(node.info->name) + "</span></h2><p class=\"dim\">" +
         escape_markup(node.info->doc) + "</p>";
  std::string summary = tasks;
  if (record.stored > 0) summary += (summary.empty() ? "" : "; ") + seconds_text(record.seconds) + " when run";
  if (node.info->cheap) summary += (summary.empty() ? "" : "; ") + std::string("its values are not kept");
  if (!summary.empty()) html += "<p>" + escape_markup(summary) + "</p>";
  html += list_of(fate.failures, "bad") + list_of(record.warnings, "warn");
  html += params_of(node) + inputs_of(graph, node);
  std::string size;
  for (std::size_t o = 0; o < record.outputs.size(); ++o) {
    const std::string& type = node.output_type[o];
    const std::string bytes = previews.size(type, record.outputs[o]);
    size = o == 0 ? bytes : size;
    html += "<h3>" + escape_markup(node.info->outputs[o].name) + " <span class=\"dim\">" +
            escape_markup(engine::port_type(type, node.output_depth[o])) + ", " + escape_markup(bytes) + "</span></h3>";
    // What the engine's own nodes pass on is shown where it was made.
    if (node.info->structural == engine::Structural::none)
      html += "<div class=\"previews\">" + previews.show(type, record.outputs[o]) + "</div>";
  }
  html += "</section>\n";
  if (record.stored > 0) size = seconds_text(record.seconds) + (size.empty() ? "" : ", " + size);
  if (!size.empty()) note.lines.push_back(size);
  if (!record.warnings.empty()) note.lines.push_back(std::to_string(record.warnings.size()) + " warnings");
  return section;
}

std::string outputs_of(const engine::Graph& graph) {
  std::string html;
  for (const engine::GraphOutput& output : graph.outputs) {
    if (output.source.kind != engine::Source::Kind::node) continue;
    const std::string& node = graph.nodes[static_cast<std::size_t>(output.source.node)].id;
    html += "<tr><th>" + escape_markup(output.name) + "</th><td><a href=\"#" + escape_markup(anchor_of(node)) + "\">" +
            escape_markup(node) + "</a></td></tr>";
  }
  return "<section><h2>Outputs</h2><table>" + html + "</table></section>\n";
}

}  // namespace

int report(const Common& common, const ReportArguments& arguments) {
  catch_interrupts();
  const auto plugins = open_plugins(common);
  engine::Graph graph;
  if (!read_graph(arguments.graph, *plugins, graph)) return invalid;
  const auto store = open_store(common);
  std::map<std::string, Fate> fates;
  std::set<std::string> told;  // failures of tasks
  ProgressPrinter progress(arguments.quiet);
  engine::RunOptions options;
  options.threads = arguments.threads;
  stop_on_interrupt(options);
  options.observer = [&](const engine::RunEvent& event) {
    fates[event.node].see(event);
    if (event.kind == engine::RunEvent::Kind::failed) told.insert(event.text);
    progress.show(event);
  };
  const engine::RunResult result = engine::run_graph(graph, *plugins, *store, options);
  progress.finish();
  if (interrupt_requested()) {
    std::fprintf(stderr, "interrupted: %zu finished tasks are kept\n", result.tasks.run);
    return interrupted;
  }

  const std::vector<engine::StoredNode> stored = engine::inspect_graph(graph, *plugins, *store);
  Previews previews(*plugins, *store);
  std::map<std::string, engine::BoxNote> notes;
  std::string sections;
  double all_seconds = 0;
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const engine::GraphNode& node = graph.nodes[n];
    if (!node.needed) continue;
    Section section = section_of(graph, node, stored[n], fates[node.id], previews);
    sections += section.html;
    notes[node.id] = std::move(section.note);
    all_seconds += stored[n].seconds;
  }

  char counts[160];
  std::snprintf(counts, sizeof counts,
                "%zu tasks run, %zu reused, %zu failed, %zu blocked in %.2f s; all results took %s to make",
                result.tasks.run, result.tasks.reused, result.tasks.failed, result.tasks.blocked, result.seconds,
                seconds_text(all_seconds).c_str());
  std::vector<std::string> other;  // failures that belong to no task
  for (const std::string& failure : result.failures)
    if (!told.contains(failure)) other.push_back(failure);
  const std::string name = std::filesystem::path(arguments.graph.path).filename().string();
  const std::string page =
      html_page(name, "<h1>" + escape_markup(name) + "</h1>\n" +
                          (graph.doc.empty() ? "" : "<p>" + escape_markup(graph.doc) + "</p>\n") + "<p>" + counts +
                          "</p>\n" + list_of(other, "bad") + list_of(graph.notes, "warn") + "<pre>" +
                          escape_markup(command_of(arguments.graph)) + "</pre>\n<section><div class=\"wide\">" +
                          engine::graph_svg(graph, notes) + "</div></section>\n" + outputs_of(graph) + sections);
  write_whole(arguments.out, page);
  const bool failed = result.tasks.failed + result.tasks.blocked > 0 || !result.failures.empty();
  if (!arguments.quiet) std::fprintf(stderr, "%s: %s\n", arguments.out.c_str(), counts);
  return failed ? task_failed : done;
}

}  // namespace cli
