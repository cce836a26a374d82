// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <utility>
#include <vector>

namespace engine {

// Where the boxes of a picture of a graph lie: in layers from left to right (Sugiyama, Tagawa and Toda, Methods for
// Visual Understanding of Hierarchical System Structures, IEEE Trans. SMC 1981): layers by longest path, crossings
// reduced by barycentres, then each box as near to its neighbours' middle as the distance to those beside it allows
// (least squares per layer, in turn).
struct LayerBox {
  double height = 40;
  double x = 0, y = 0;  // its left edge, its middle
};
struct LayerEdge {
  int from = 0, to = 0;  // boxes; without rings
  std::vector<std::pair<double, double>>
      bends;  // where it passes the layers between them: left, then right edge of each
};
struct LayerSizes {
  double box_width = 190, column_gap = 70, row_gap = 18;
};
struct LayerSize {
  double width = 0, height = 0;
};
LayerSize lay_out(std::vector<LayerBox>& boxes, std::vector<LayerEdge>& edges, const LayerSizes& sizes = {});

}  // namespace engine
