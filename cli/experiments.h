// SPDX-License-Identifier: Apache-2.0
// The commands for experiments, one file each: like those of commands.h each returns the exit code.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "cli/context.h"

namespace cli {

struct SweepArguments {
  GraphArguments graph;
  std::vector<std::string> vary;     // "flow.node=flow.scan,flow.dis"
  std::vector<std::string> metrics;  // the first one sorts
  std::string out;                   // folder for sweep.csv and sweep.json
  bool largest_first = false;
  bool outputs = false;  // publish the outputs of each variant too
  bool quiet = false;
  int threads = 0;
  std::string memory;
};
int sweep(const Common& common, const SweepArguments& arguments);

struct GraphPictureArguments {
  GraphArguments graph;
  bool svg = false;  // which is the default
  bool dot = false;
  std::string out;  // empty = standard output
};
int graph_picture(const Common& common, const GraphPictureArguments& arguments);

struct ReportArguments {
  GraphArguments graph;
  std::string out = "report.html";
  int threads = 0;
  bool quiet = false;
};
int report(const Common& common, const ReportArguments& arguments);

struct CompareArguments {
  std::string a, b;                 // graph files (b may be empty: a again), or two folders or files that were made
  std::string out;                  // a page with pictures; empty = none
  std::vector<std::string> sets;    // for both
  std::vector<std::string> sets_a;  // for one
  std::vector<std::string> sets_b;
  int threads = 0;
  bool all = false;  // list every element that differs
  bool json = false;
  bool quiet = false;
};
// Exit code 0 also where they differ: that is the answer.
int compare(const Common& common, const CompareArguments& arguments);

struct NewArguments {
  std::string folder;
  std::string from;   // a folder of the installed graphs, or how its name begins
  bool list = false;  // say what there is
};
int make_new(const Common& common, const NewArguments& arguments);

struct DoctorArguments {
  std::string file;               // or a folder; empty: look at the installation
  std::vector<std::string> sets;  // parameters of the graph that looks at it
  std::string out = ".";          // folder for what it writes
};
// What a run would stumble over: plugins, files that installed graphs expect, the store and its disk; or a file that a
// plugin has a check for. Exit code 1 where something is wrong.
int doctor(const Common& common, const DoctorArguments& arguments);

// The commands and options of the command line, taken from it where it is declared.
struct CommandTree {
  struct Option {
    std::vector<std::string> names;  // "-o", "--output"
    std::string doc, value;          // value: "FILE", "NODE"; empty for a flag
  };
  std::string name, doc;
  std::vector<Option> options;
  std::vector<CommandTree> commands;
};
// The completion script of a shell: "bash" or "zsh".
std::string completion_script(const CommandTree& tree, const std::string& shell);

// Where the installed graphs are.
std::string graphs_folder();

// Writes a file in one step: whoever looks sees the old one or the new one. Makes its folder. Throws EngineError.
void write_whole(const std::string& path, std::string_view bytes);
// The settings of --set; throws std::invalid_argument for what is none.
std::vector<engine::Setting> settings_of(const std::vector<std::string>& sets);
// A word as a shell takes it: quoted where it must be.
std::string shell_word(const std::string& text);
// Of ASCII's letters.
std::string lower(std::string text);
// So many bytes of a text from its beginning, or fewer, so that no character (UTF-8) is cut in two.
std::string beginning(const std::string& text, std::size_t most_bytes);
// The beginning of a long text, for one line among others.
std::string shortened(const std::string& text);

}  // namespace cli
