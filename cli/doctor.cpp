// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "cli/commands.h"
#include "cli/experiments.h"
#include "engine/run/run.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t little_room_bytes = 2'000'000'000;

class Findings {
 public:
  void good(const std::string& text) { std::printf("ok       %s\n", text.c_str()); }
  void bad(const std::string& text, const std::string& remedy) {
    ++bad_;
    std::printf("problem  %s\n         %s\n", text.c_str(), remedy.c_str());
  }
  // The lines of a text, as they are.
  void say(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      std::printf("         %s\n", text.substr(at, end - at).c_str());
      at = end + 1;
    }
  }
  int end() const {
    std::printf("%s\n", bad_ == 0 ? "nothing is wrong"
                                  : (std::to_string(bad_) + (bad_ == 1 ? " problem" : " problems")).c_str());
    return bad_ == 0 ? done : task_failed;
  }

 private:
  std::size_t bad_ = 0;
};

void check_plugins(const Common& common, const engine::Plugins& plugins, Findings& findings) {
  for (const engine::Problem& problem : plugins.problems())
    findings.bad("plugin " + problem.place.file + ": " + problem.text,
                 "rebuild it against this version, or remove the file");
  std::string names, folders;
  for (const std::string& name : plugins.plugin_names()) names += (names.empty() ? "" : ", ") + name;
  for (const std::string& folder : plugin_folders(common)) folders += (folders.empty() ? "" : ", ") + folder;
  if (names.empty())
    findings.bad("there are no plugins in " + folders, "install Facegraph whole, or name their folder with --plugins");
  else
    findings.good(std::to_string(plugins.node_names().size()) + " nodes of the plugins " + names);
}

// Files that installed graphs expect to be there: acoustic models, dictionaries, tables.
void check_graphs(const engine::Plugins& plugins, Findings& findings) {
  const fs::path graphs = graphs_folder();
  std::error_code error;
  std::size_t sound = 0;
  std::set<std::string> missing;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(graphs, error))
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    if (path.string().find("/broken/") != std::string::npos) continue;
    const engine::GraphReading reading = read_graph(path.string(), {}, plugins);
    if (reading.problems.empty()) ++sound;
    for (const engine::Problem& problem : reading.problems)
      if (problem.place.pointer.ends_with("/default") && problem.text.find("exist") != std::string::npos &&
          missing.insert(problem.text).second)
        findings.bad(problem.line(), "install the package that has it, or give another one with --set");
  }
  if (paths.empty())
    findings.bad("there are no graphs in " + graphs.string(),
                 "install Facegraph whole; your own graphs work without them");
  else
    findings.good(std::to_string(paths.size()) + " files in " + graphs.string() + ", " + std::to_string(sound) +
                  " of them graphs that run as they are");
}

void check_store(const Common& common, Findings& findings) {
  std::string folder;
  try {
    const auto store = open_store(common);
    folder = store->folder();
    const engine::StoreStat stat = store->stat();
    findings.good("store " + folder + ": " + show_size(stat.object_bytes));
  } catch (const std::exception& error) {
    return findings.bad(error.what(), "name another folder with FACEGRAPH_STORE or --store");
  }
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error)
    return findings.bad("how much room " + folder + " has cannot be told: " + error.message(), "look at the disk");
  if (space.available < little_room_bytes)
    findings.bad("only " + show_size(space.available) + " are free where the store lies",
                 "make room, run facegraph cache gc, or name another folder with FACEGRAPH_STORE");
  else
    findings.good(show_size(space.available) + " are free there");
}

// Which kinds of file plugins can look at, and the graph for one: checks/SUFFIX.json, for a folder checks/folder.json.
std::string check_for(const Common& common, const fs::path& file, std::string& known) {
  const std::string kind = fs::is_directory(file) ? "folder" : lower(file.extension().string());
  std::set<std::string> kinds;
  std::string graph;
  for (const std::string& folder : plugin_folders(common)) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / "checks", error)) {
      const std::string stem = entry.path().stem().string(), name = stem == "folder" ? "a folder" : "." + stem;
      if (entry.path().extension() != ".json" || !kinds.insert(name).second) continue;
      if (stem == kind || "." + stem == kind) graph = entry.path().string();
    }
  }
  for (const std::string& name : kinds) known += (known.empty() ? "" : ", ") + name;
  return graph;
}

// Runs the graph that a plugin has for such a file. Its node "check" says what was found (text) and whether all is well
// (sound); its outputs are put into the folder, but not over what is there.
void check_file(const Common& common, const DoctorArguments& arguments, const engine::Plugins& plugins,
                Findings& findings) {
  std::string known;
  if (!fs::exists(arguments.file))
    throw std::invalid_argument("command line: there is no file or folder " + arguments.file);
  const std::string path = check_for(common, arguments.file, known);
  if (path.empty())
    throw std::invalid_argument("command line: doctor " + arguments.file + ": expected " +
                                (known.empty() ? "nothing" : known));
  std::vector<engine::Setting> settings = settings_of(arguments.sets);
  settings.push_back({"file", arguments.file});
  engine::GraphReading reading = read_graph(path, settings, plugins);
  for (const engine::Problem& problem : reading.problems) findings.bad(problem.line(), "see --help");
  if (!reading.problems.empty()) return;
  const auto store = open_store(common);
  auto loaded = open_plugins(common);
  engine::RunOptions options;
  std::vector<std::string> there, made;
  for (const engine::GraphOutput& output : reading.graph.outputs)
    (fs::exists(fs::path(arguments.out) / output.name) ? there : made)
        .push_back((fs::path(arguments.out) / output.name).lexically_normal().string());
  if (there.empty()) options.out_folder = arguments.out;
  const engine::RunResult ran = engine::run_graph(reading.graph, *loaded, *store, options);
  if (!ran.failures.empty()) return findings.bad(ran.failures[0], "give another file");
  const auto value = [&](const char* output) {
    return engine::get_value(reading.graph, *loaded, *store, {.node = "check", .output = output, .element = {}}, {})
        .value;
  };
  const bool sound = value("sound").as<bool>();
  if (sound)
    findings.good(arguments.file);
  else
    findings.bad(arguments.file, "what was found:");
  findings.say(value("text").as<std::string>());
  for (const std::string& name : there)
    findings.say(name + " is there already and was left alone: name another folder with --out");
  if (there.empty())
    for (const std::string& name : made) findings.say("wrote " + name);
}

}  // namespace

int doctor(const Common& common, const DoctorArguments& arguments) {
  Findings findings;
  const engine::Plugins plugins(plugin_folders(common));
  if (!arguments.file.empty()) {
    check_file(common, arguments, plugins, findings);
    return findings.end();
  }
  check_plugins(common, plugins, findings);
  check_graphs(plugins, findings);
  check_store(common, findings);
  return findings.end();
}

}  // namespace cli
