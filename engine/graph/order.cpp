// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "engine/graph/flat_graph.h"

namespace engine {
namespace {

// ring: each node needs the next, the last the first.
void report_ring(const FlatGraph& flat, std::vector<int> ring, std::vector<Problem>& problems) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  std::string text;
  for (const int node : ring) text += flat.nodes[node].id + " needs ";
  Place place = flat.nodes[ring[0]].place;
  const int next = ring.size() > 1 ? ring[1] : ring[0];
  for (const auto& links : flat.nodes[ring[0]].ports)
    for (const Link& link : links)
      if (link.kind == Link::Kind::node && link.node == next) place = link.place;
  problems.push_back({place, "the nodes need each other in a ring: " + text + flat.nodes[ring[0]].id});
}

struct Step {
  int node;
  std::size_t port = 0, link = 0;  // what comes next
};

enum class Mark { fresh, on_path, done };

}  // namespace

// A depth-first search with its own stack: chains may be long.
std::vector<int> find_order(const FlatGraph& flat, std::vector<bool>& on_ring, std::vector<Problem>& problems) {
  std::vector<int> order;
  std::vector<Mark> marks(flat.nodes.size(), Mark::fresh);
  std::vector<Step> path;
  const auto enter = [&](int node) {
    marks[node] = Mark::on_path;
    path.push_back({node});
  };
  const auto close_ring = [&](int first) {
    std::vector<int> ring;
    for (auto at = path.rbegin(); ring.empty() || ring.back() != first; ++at) ring.push_back(at->node);
    std::reverse(ring.begin(), ring.end());
    const bool told = std::any_of(ring.begin(), ring.end(), [&](int node) { return on_ring[node]; });
    for (const int node : ring) on_ring[node] = true;
    if (!told) report_ring(flat, std::move(ring), problems);
  };
  for (std::size_t start = 0; start < flat.nodes.size(); ++start) {
    if (marks[start] == Mark::fresh) enter(static_cast<int>(start));
    while (!path.empty()) {
      Step& step = path.back();
      const auto& ports = flat.nodes[step.node].ports;
      if (step.port == ports.size()) {
        marks[step.node] = Mark::done;
        order.push_back(step.node);
        path.pop_back();
      } else if (step.link == ports[step.port].size()) {
        ++step.port;
        step.link = 0;
      } else if (const Link& link = ports[step.port][step.link++]; link.kind == Link::Kind::node) {
        if (marks[link.node] == Mark::fresh)
          enter(link.node);
        else if (marks[link.node] == Mark::on_path)
          close_ring(link.node);
      }
    }
  }
  return order;
}

}  // namespace engine
