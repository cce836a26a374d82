// SPDX-License-Identifier: Apache-2.0
#include "engine/describe/layers.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace engine {
namespace {

constexpr int order_sweeps = 24, place_sweeps = 16;
constexpr double bend_height = 6;

// A box, or the place where an edge passes a layer.
struct Item {
  int box = -1;
  double height = bend_height, y = 0;
  std::size_t layer = 0, position = 0;
  std::vector<std::size_t> before, after;  // neighbours in the layers at its sides
};

using Layer = std::vector<std::size_t>;

std::size_t crossings(const std::vector<Item>& items, const Layer& layer) {
  std::size_t count = 0;
  for (std::size_t a = 0; a < layer.size(); ++a)
    for (std::size_t b = a + 1; b < layer.size(); ++b)
      for (const std::size_t from_a : items[layer[a]].before)
        for (const std::size_t from_b : items[layer[b]].before)
          count += items[from_a].position > items[from_b].position;
  return count;
}

std::size_t crossings(const std::vector<Item>& items, const std::vector<Layer>& layers) {
  std::size_t count = 0;
  for (const Layer& layer : layers) count += crossings(items, layer);
  return count;
}

void number(std::vector<Item>& items, const Layer& layer) {
  for (std::size_t i = 0; i < layer.size(); ++i) items[layer[i]].position = i;
}

void order(std::vector<Item>& items, std::vector<Layer>& layers) {
  std::vector<Layer> best = layers;
  std::size_t fewest = crossings(items, layers);
  for (int sweep = 0; sweep < order_sweeps && fewest > 0; ++sweep) {
    const bool forward = sweep % 2 == 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      Layer& layer = layers[forward ? i : layers.size() - 1 - i];
      const auto centre = [&](std::size_t item) {
        const auto& near = forward ? items[item].before : items[item].after;
        double sum = 0;
        for (const std::size_t other : near) sum += static_cast<double>(items[other].position);
        return near.empty() ? static_cast<double>(items[item].position) : sum / static_cast<double>(near.size());
      };
      std::vector<std::pair<double, std::size_t>> keyed;
      for (const std::size_t item : layer) keyed.emplace_back(centre(item), item);
      std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t k = 0; k < keyed.size(); ++k) layer[k] = keyed[k].second;
      number(items, layer);
    }
    if (const std::size_t now = crossings(items, layers); now < fewest) {
      fewest = now;
      best = layers;
    }
  }
  layers = best;
  for (const Layer& layer : layers) number(items, layer);
}

// The places nearest to those wanted, in order and `gap` apart: pooled where they would overlap.
void place(std::vector<Item>& items, const Layer& layer, const std::vector<double>& wanted, double gap) {
  struct Pool {
    double sum;
    std::size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<double> offset(layer.size(), 0);
  for (std::size_t i = 1; i < layer.size(); ++i)
    offset[i] = offset[i - 1] + (items[layer[i - 1]].height + items[layer[i]].height) / 2 + gap;
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    pools.push_back({wanted[i] - offset[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  std::size_t i = 0;
  for (const Pool& pool : pools)
    for (std::size_t k = 0; k < pool.count; ++k, ++i) items[layer[i]].y = pool.mean() + offset[i];
}

void place_all(std::vector<Item>& items, const std::vector<Layer>& layers, double gap) {
  for (const Layer& layer : layers) place(items, layer, std::vector<double>(layer.size(), 0), gap);
  for (int sweep = 0; sweep < place_sweeps; ++sweep) {
    const bool forward = sweep % 2 == 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const Layer& layer = layers[forward ? i : layers.size() - 1 - i];
      std::vector<double> wanted;
      for (const std::size_t item : layer) {
        // Towards both sides, more to the one that this sweep comes from.
        double sum = 0, weight = 0;
        const auto pull = [&](const std::vector<std::size_t>& near, double strength) {
          for (const std::size_t other : near) {
            const double w = strength / static_cast<double>(near.size());
            sum += w * items[other].y;
            weight += w;
          }
        };
        pull(items[item].before, forward ? 2 : 1);
        pull(items[item].after, forward ? 1 : 2);
        wanted.push_back(weight > 0 ? sum / weight : items[item].y);
      }
      place(items, layer, wanted, gap);
    }
  }
}

}  // namespace

LayerSize lay_out(std::vector<LayerBox>& boxes, std::vector<LayerEdge>& edges, const LayerSizes& sizes) {
  LayerSize size;
  if (boxes.empty()) return size;
  std::vector<Item> items(boxes.size());
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    items[b].box = static_cast<int>(b);
    items[b].height = boxes[b].height;
  }
  // Longest paths; a graph of n boxes needs at most n rounds.
  for (std::size_t round = 0; round < boxes.size(); ++round) {
    bool moved = false;
    for (const LayerEdge& edge : edges) {
      const std::size_t least = items[static_cast<std::size_t>(edge.from)].layer + 1;
      std::size_t& layer = items[static_cast<std::size_t>(edge.to)].layer;
      if (layer < least) layer = least, moved = true;
    }
    if (!moved) break;
  }
  // What nothing comes before stands next to what it leads to.
  std::vector<bool> has_input(boxes.size(), false);
  std::vector<std::size_t> nearest(boxes.size(), boxes.size());
  for (const LayerEdge& edge : edges) {
    has_input[static_cast<std::size_t>(edge.to)] = true;
    std::size_t& least = nearest[static_cast<std::size_t>(edge.from)];
    least = std::min(least, items[static_cast<std::size_t>(edge.to)].layer);
  }
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (!has_input[b] && nearest[b] < boxes.size()) items[b].layer = nearest[b] - 1;

  std::size_t last = 0;
  for (const Item& item : items) last = std::max(last, item.layer);
  std::vector<std::vector<std::size_t>> bends(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::size_t from = static_cast<std::size_t>(edges[e].from);
    const auto to = static_cast<std::size_t>(edges[e].to);
    for (std::size_t layer = items[from].layer + 1; layer < items[to].layer; ++layer) {
      Item bend;
      bend.layer = layer;
      bend.before = {from};
      items[from].after.push_back(items.size());
      from = items.size();
      bends[e].push_back(from);
      items.push_back(std::move(bend));
    }
    items[from].after.push_back(to);
    items[to].before.push_back(from);
  }
  std::vector<Layer> layers(last + 1);
  for (std::size_t i = 0; i < items.size(); ++i) layers[items[i].layer].push_back(i);
  for (const Layer& layer : layers) number(items, layer);
  order(items, layers);
  place_all(items, layers, sizes.row_gap);

  double top = items[0].y, bottom = items[0].y;
  for (const Item& item : items) {
    top = std::min(top, item.y - item.height / 2);
    bottom = std::max(bottom, item.y + item.height / 2);
  }
  const auto x_of = [&](std::size_t layer) {
    return static_cast<double>(layer) * (sizes.box_width + sizes.column_gap);
  };
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    boxes[b].x = x_of(items[b].layer);
    boxes[b].y = items[b].y - top;
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    edges[e].bends.clear();
    for (const std::size_t bend : bends[e]) {
      edges[e].bends.emplace_back(x_of(items[bend].layer), items[bend].y - top);
      edges[e].bends.emplace_back(x_of(items[bend].layer) + sizes.box_width, items[bend].y - top);
    }
  }
  size.width = x_of(last) + sizes.box_width;
  size.height = bottom - top;
  return size;
}

}  // namespace engine
