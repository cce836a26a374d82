// SPDX-License-Identifier: Apache-2.0
// One function, and one file, per command. Each returns the exit code.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "cli/context.h"

namespace cli {

struct RunArguments {
  GraphArguments graph;
  std::string out;
  std::string out_name;  // of the graph's only output, instead of its own; empty = its own
  std::string to;
  std::vector<std::string> elements;
  int threads = 0;
  std::string memory;  // "500MB"
  bool fail_fast = false;
  bool quiet = false;
  std::string events;   // NDJSON here ("-" = standard output)
  std::string trace;    // Chrome trace here
  std::string summary;  // JSON here
};
int run(const Common& common, const RunArguments& arguments);

struct PlanArguments {
  GraphArguments graph;
  bool all = false;  // list cached tasks too
  bool json = false;
};
int plan(const Common& common, const PlanArguments& arguments);

struct ExplainArguments {
  GraphArguments graph;
  std::string task;  // "node" or "node[17]"
  bool json = false;
};
int explain(const Common& common, const ExplainArguments& arguments);

struct GetArguments {
  GraphArguments graph;
  std::string reference;
  std::string out;  // file; empty = JSON on standard output
};
int get(const Common& common, const GetArguments& arguments);

int validate(const Common& common, const GraphArguments& arguments);

struct NodesArguments {
  std::string filter;
  bool json = false;
  bool markdown = false;  // the reference page of all nodes
};
int nodes(const Common& common, const NodesArguments& arguments);

struct DescribeArguments {
  std::string name;  // of a node or a value type
  bool json = false;
};
int describe(const Common& common, const DescribeArguments& arguments);

int schema(const Common& common);

struct CacheArguments {
  std::string action;    // stat, gc, pin, unpin, verify, audit
  std::string max_size;  // "50GB"
  double max_age_days = 0;
  std::string name;           // pin, unpin
  GraphArguments graph;       // pin, audit
  std::string sample = "5%";  // audit
  std::uint64_t seed = 1;     // audit
};
int cache(const Common& common, const CacheArguments& arguments);

// Commands that plugins ship as data: graphs in a folder `commands` beside the libraries, NAME.json run by `facegraph
// NAME` with the graph's parameters as options.
struct PluginCommand {
  std::string name;
  std::string path;  // of the graph
  std::string doc;   // what the graph says it is for
};
// All of them, by name. Of two with one name that of the earlier folder counts.
std::vector<PluginCommand> plugin_commands(const Common& common);
// What --help says of them; empty where there are none.
std::string plugin_commands_help(const Common& common);
// Runs the command that the words of a command line name, if any; `words` without the program's name, `own` the
// program's own commands, whose names no plugin takes. Returns false where they name none.
bool run_plugin_command(std::vector<std::string> words, const std::vector<std::string>& own, int& exit_code);

// "500MB" -> bytes (decimal units). Throws std::invalid_argument, naming the option, for what is no amount.
std::int64_t size_of(const std::string& option, const std::string& text);
// What the store may hold: --store-limit, else FACEGRAPH_STORE_LIMIT, else 50 GB.
inline constexpr std::int64_t default_store_limit_bytes = 50'000'000'000;
std::int64_t store_limit(const Common& common);
// Collects what was not used for longest where the store is over its limit, and says so.
void keep_to_limit(engine::Store& store, std::int64_t limit_bytes);
std::string show_size(std::uint64_t bytes);

}  // namespace cli
