// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "cli/commands.h"
#include "engine/graph/param_value.h"
#include "engine/run/run.h"

namespace cli {
namespace {

constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB"};

// "5%" -> 0.05
double parse_share(const std::string& text) {
  char* rest = nullptr;
  const double number = std::strtod(text.c_str(), &rest);
  if (rest == text.c_str() || std::string(rest) != "%" || !(number > 0 && number <= 100))
    throw std::invalid_argument("command line: --sample " + text +
                                ": expected a share above 0% and up to 100%, such as 5%");
  return number / 100;
}

int audit(const engine::Graph& graph, engine::Plugins& plugins, engine::Store& store, const CacheArguments& arguments) {
  const double share = parse_share(arguments.sample);
  const engine::AuditResult result = engine::audit_graph(graph, plugins, store, share, arguments.seed, {});
  for (const std::string& text : result.differing) std::printf("differs: %s\n", text.c_str());
  std::printf("%zu of %zu stored tasks run again, %zu differ\n", result.checked, result.stored,
              result.differing.size());
  return result.differing.empty() ? done : task_failed;
}

}  // namespace

std::int64_t size_of(const std::string& option, const std::string& text) {
  if (const auto bytes = engine::parse_size(text)) return *bytes;
  throw std::invalid_argument("command line: " + option + " " + text + ": expected an amount such as " +
                              std::string(engine::size_examples));
}

std::string show_size(std::uint64_t bytes) {
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 1000 && unit + 1 < std::size(units)) {
    value /= 1000;
    ++unit;
  }
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
  return text;
}

std::int64_t store_limit(const Common& common) {
  if (!common.store_limit.empty()) return size_of("--store-limit", common.store_limit);
  if (const char* set = std::getenv("FACEGRAPH_STORE_LIMIT")) return size_of("FACEGRAPH_STORE_LIMIT", set);
  return default_store_limit_bytes;
}

void keep_to_limit(engine::Store& store, std::int64_t limit_bytes) {
  const auto limit = static_cast<std::uint64_t>(limit_bytes);
  if (store.object_bytes() <= limit) return;
  const engine::GcResult result = store.gc(limit, 0);
  std::fprintf(stderr, "the store was over %s: %s removed that were not used for longest, %s left\n",
               show_size(limit).c_str(), show_size(result.removed_bytes).c_str(), show_size(result.kept_bytes).c_str());
}

int cache(const Common& common, const CacheArguments& arguments) {
  const auto store = open_store(common);
  if (arguments.action == "stat") {
    const engine::StoreStat stat = store->stat();
    std::printf("%s\n%llu objects, %s; %llu tasks, %llu small values, %llu pins\n", store->folder().c_str(),
                static_cast<unsigned long long>(stat.objects), show_size(stat.object_bytes).c_str(),
                static_cast<unsigned long long>(stat.records), static_cast<unsigned long long>(stat.small_values),
                static_cast<unsigned long long>(stat.pins));
    return done;
  }
  if (arguments.action == "gc") {
    const std::int64_t size =
        arguments.max_size.empty() ? store_limit(common) : size_of("--max-size", arguments.max_size);
    const engine::GcResult result = store->gc(static_cast<std::uint64_t>(size), arguments.max_age_days * 86400);
    std::printf("removed %llu objects, %s; %s left\n", static_cast<unsigned long long>(result.removed_objects),
                show_size(result.removed_bytes).c_str(), show_size(result.kept_bytes).c_str());
    return done;
  }
  if (arguments.action == "verify") {
    const engine::VerifyResult result = store->verify();
    for (const engine::Digest& digest : result.damaged) std::printf("damaged, removed: %s\n", digest.hex().c_str());
    std::printf("%llu objects checked, %zu damaged\n", static_cast<unsigned long long>(result.checked),
                result.damaged.size());
    return result.damaged.empty() ? done : task_failed;
  }
  if (arguments.action == "unpin") {
    store->unpin(arguments.name);
    return done;
  }
  const auto plugins = open_plugins(common);
  engine::Graph graph;
  if (!read_graph(arguments.graph, *plugins, graph)) return invalid;
  if (arguments.action == "audit") return audit(graph, *plugins, *store, arguments);
  const std::vector<engine::Digest> digests = engine::values_of(graph, *plugins, *store);
  store->pin(arguments.name, digests);
  std::printf("pinned %zu values as %s\n", digests.size(), arguments.name.c_str());
  return done;
}

}  // namespace cli
