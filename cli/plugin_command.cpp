// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cli/commands.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& text) { throw std::invalid_argument("command line: " + text); }

// "--name=value" and "--name value"; what is taken is removed. Returns false at the end of the words.
class Words {
 public:
  explicit Words(std::vector<std::string> words) : words_(std::move(words)) {}
  bool next(std::string& option, std::string& value, bool& has_value) {
    if (at_ >= words_.size()) return false;
    option = words_[at_++];
    const std::size_t equals = option.starts_with("--") ? option.find('=') : std::string::npos;
    has_value = equals != std::string::npos;
    if (has_value) value = option.substr(equals + 1), option.erase(equals);
    return true;
  }
  std::string value_of(const std::string& option) {
    if (at_ >= words_.size()) refuse(option + " needs a value");
    return words_[at_++];
  }
  bool value_follows() const { return at_ < words_.size() && !words_[at_].starts_with("--"); }

 private:
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

std::string kind_of(const engine::GraphParam& param) {
  if (param.path) return "PATH";
  if (!param.info.choices.empty()) {
    std::string choices;
    for (const std::string& choice : param.info.choices) choices += (choices.empty() ? "" : "|") + choice;
    return choices;
  }
  switch (param.info.kind) {
    case engine::ParamKind::boolean:
      return "true|false";
    case engine::ParamKind::integer:
      return "INTEGER";
    case engine::ParamKind::real:
      return "NUMBER";
    default:
      return "TEXT";
  }
}

// As it is typed: parameters are spelt with underscores in graphs.
std::string option_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

void print_line(const std::string& option, const std::string& doc) {
  std::printf("  %-32s %s\n", option.c_str(), doc.c_str());
}

void print_help(const PluginCommand& command, const std::vector<engine::GraphParam>& params) {
  std::printf("%s\nUsage: facegraph %s [OPTIONS]\n\nOptions:\n", command.doc.c_str(), command.name.c_str());
  for (const engine::GraphParam& param : params)
    print_line(option_of(param.info.name) + " " + kind_of(param),
               param.info.doc + (param.optional || param.has_default ? "" : " (needed)"));
  print_line("--out PATH", "Folder for the outputs (default: this one), or the file that the only output becomes");
  print_line("--set NODE.PARAM=VALUE", "A parameter of a node of the graph");
  print_line("--quiet", "Print failures only");
  print_line("--store FOLDER", "Where results are kept");
  print_line("--plugins FOLDER", "Further folders of plugins");
  std::printf("\nIt runs the graph %s\n", command.path.c_str());
}

// "page.html" where the command's one output is such a file: where it goes and how it is called there.
void name_output(const std::string& out, const engine::Graph& graph, RunArguments& run) {
  const fs::path path = out;
  run.out = out;
  if (graph.outputs.size() != 1 || fs::is_directory(path) || path.extension().empty() ||
      path.extension() != fs::path(graph.outputs[0].name).extension())
    return;
  run.out = path.parent_path().empty() ? "." : path.parent_path().string();
  run.out_name = path.filename().string();
}

int run_command(const PluginCommand& command, Common common, Words words) {
  const auto plugins = open_plugins(common);
  const engine::GraphReading declared = read_graph(command.path, {}, *plugins);
  const std::vector<engine::GraphParam>& params = declared.graph.params;
  RunArguments run;
  run.graph.path = command.path;
  std::string option, value, out = ".";
  std::map<std::string, bool> given;
  for (bool has_value = false; words.next(option, value, has_value);) {
    if (option == "--help" || option == "-h") return print_help(command, params), done;
    if (!option.starts_with("--")) refuse(option + " is no option of " + command.name + ": they start with --");
    std::string name = option.substr(2);
    std::replace(name.begin(), name.end(), '-', '_');
    if (name == "quiet") {
      run.quiet = true;
      continue;
    }
    const auto param = std::find_if(params.begin(), params.end(), [&](const auto& p) { return p.info.name == name; });
    const bool known = param != params.end();
    std::vector<std::string> names = {"--out", "--set", "--quiet", "--store", "--plugins", "--help"};
    for (const auto& p : params) names.push_back(option_of(p.info.name));
    if (!known && std::find(names.begin(), names.end(), option) == names.end())
      refuse(command.name + " has no option " + option + engine::did_you_mean(option, names));
    if (!has_value)
      value = known && param->info.kind == engine::ParamKind::boolean && !words.value_follows()
                  ? "true"
                  : words.value_of(option);
    if (known) {
      if (given[name]) refuse(option + " is given twice");
      given[name] = true;
      run.graph.sets.push_back(name + "=" + value);
    } else if (name == "out") {
      out = value;
    } else if (name == "set") {
      run.graph.sets.push_back(value);
    }  // --store and --plugins were read before
  }
  for (const engine::GraphParam& param : params)
    if (!param.optional && !param.has_default && !given[param.info.name])
      refuse(command.name + " needs " + option_of(param.info.name) + " " + kind_of(param) + ": " + param.info.doc);
  name_output(out, declared.graph, run);
  if (run.out_name.empty() && declared.graph.outputs.empty()) {
    engine::Graph graph;  // its outputs are known only with the settings
    if (!read_graph(run.graph, *plugins, graph)) return invalid;
    name_output(out, graph, run);
  }
  return cli::run(common, run);
}

}  // namespace

std::vector<PluginCommand> plugin_commands(const Common& common) {
  std::map<std::string, PluginCommand> found;
  for (const std::string& folder : plugin_folders(common)) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / "commands", error)) {
      if (entry.path().extension() != ".json") continue;
      PluginCommand command{entry.path().stem().string(), entry.path().string(), {}};
      std::ifstream file(command.path);
      const auto json = nlohmann::json::parse(file, nullptr, false, true);
      if (json.is_object() && json.contains("doc") && json["doc"].is_string()) command.doc = json["doc"];
      found.emplace(command.name, std::move(command));
    }
  }
  std::vector<PluginCommand> commands;
  for (auto& [name, command] : found) commands.push_back(std::move(command));
  return commands;
}

std::string plugin_commands_help(const Common& common) {
  std::string text;
  for (const PluginCommand& command : plugin_commands(common)) {
    std::string name = "  " + command.name;
    name.resize(std::max<std::size_t>(name.size() + 2, 30), ' ');
    text += (text.empty() ? "Commands of plugins (NAME --help says more):\n" : "\n") + name + command.doc;
  }
  return text;
}

bool run_plugin_command(std::vector<std::string> words, const std::vector<std::string>& own, int& exit_code) {
  Common common;
  std::string option, value, name;
  std::size_t at = 0;
  // The first word that is neither an option of the program nor its value.
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool folders = word == "--plugins" || word.starts_with("--plugins="),
               store = word == "--store" || word.starts_with("--store=");
    if (folders || store) {
      const std::size_t equals = word.find('=');
      if (equals == std::string::npos && i + 1 >= words.size()) return false;
      const std::string text = equals == std::string::npos ? words[++i] : word.substr(equals + 1);
      if (folders) common.plugin_folders.push_back(text);
      if (store) common.store = text;
    } else if (name.empty()) {
      if (word.starts_with("-")) return false;
      name = word;
      at = i;
    }
  }
  if (name.empty() || std::find(own.begin(), own.end(), name) != own.end()) return false;
  for (const PluginCommand& command : plugin_commands(common))
    if (command.name == name) {
      words.erase(words.begin() + static_cast<std::ptrdiff_t>(at));
      exit_code = run_command(command, common, Words(std::move(words)));
      return true;
    }
  return false;
}

}  // namespace cli
