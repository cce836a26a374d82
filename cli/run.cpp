// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <set>

#include "cli/commands.h"
#include "cli/events.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/trace.h"
#include "engine/run/run.h"

namespace cli {

int run(const Common& common, const RunArguments& arguments) {
  catch_interrupts();
  const auto plugins = open_plugins(common);
  engine::Graph graph;
  if (!read_graph(arguments.graph, *plugins, graph)) return invalid;
  if (!arguments.out_name.empty()) graph.outputs.at(0).name = arguments.out_name;
  if (!arguments.elements.empty() && arguments.to.empty()) {
    std::fprintf(stderr, "command line: --elements goes with --to NODE\n");
    return invalid;
  }
  const std::int64_t limit_bytes = store_limit(common);
  const auto store = open_store(common);
  if (!arguments.summary.empty()) check_writable(arguments.summary);

  ProgressPrinter progress(arguments.quiet);
  EventWriter events(arguments.events);
  TraceWriter trace(arguments.trace);
  engine::RunOptions options;
  options.threads = arguments.threads;
  if (!arguments.memory.empty()) options.memory_bytes = size_of("--memory", arguments.memory);
  options.fail_fast = arguments.fail_fast;
  options.to = arguments.to;
  options.elements = arguments.elements;
  options.out_folder = arguments.out;
  stop_on_interrupt(options);
  std::set<std::string> told;  // failures are told as they happen
  options.observer = [&](const engine::RunEvent& event) {
    if (event.kind == engine::RunEvent::Kind::failed) told.insert(event.text);
    events.write(event);
    trace.write(event);
    progress.show(event);
  };
  const engine::RunResult result = engine::run_graph(graph, *plugins, *store, options);
  progress.finish();
  if (result.tasks.run > 0) keep_to_limit(*store, limit_bytes);
  for (const engine::Digest& digest : store->take_damaged())
    std::fprintf(stderr,
                 "warning: the store's object %s was damaged: it was removed, and is made again where it is read\n",
                 digest.brief().c_str());
  if (!arguments.summary.empty()) write_summary(arguments.summary, result);
  if (interrupt_requested()) {
    std::fprintf(stderr, "interrupted: %zu finished tasks are kept\n", result.tasks.run);
    return interrupted;
  }
  for (const std::string& failure : result.failures)
    if (!told.contains(failure)) std::fprintf(stderr, "failed: %s\n", failure.c_str());
  const bool failed = result.tasks.failed + result.tasks.blocked > 0 || !result.failures.empty();
  if (!arguments.quiet || failed)
    std::fprintf(stderr, "%zu run, %zu reused, %zu failed, %zu blocked in %.2f s\n", result.tasks.run,
                 result.tasks.reused, result.tasks.failed, result.tasks.blocked, result.seconds);
  if (!failed && arguments.to.empty()) {
    if (!arguments.out.empty() && result.published.empty())
      std::fprintf(stderr,
                   "warning: nothing was published: the sequences that the outputs are made of have no elements\n");
    if (arguments.out.empty() && !arguments.quiet)
      std::fprintf(stderr, "nothing was published: say where with --out FOLDER\n");
  }
  if (!arguments.quiet)
    for (const std::string& path : result.published) std::fprintf(stdout, "%s\n", path.c_str());
  return failed ? task_failed : done;
}

}  // namespace cli
