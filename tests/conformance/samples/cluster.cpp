// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "nodes/types/matrix.h"
#include "nodes/types/table.h"
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

// Four heaps of six points that flow into each other, of 3 numbers each.
const Maker heaps = made([](int variant) {
  face::Matrix points{24, 3, {}};
  for (int i = 0; i < 24; ++i)
    for (int d = 0; d < 3; ++d)
      points.values.push_back(2 * ((i / 6 >> d) & 1) + 0.8 * std::sin(2.1 * i + 1.3 * d + 0.2 * variant) + 0.1 * d);
  return points;
});

const Maker rest = made([](int variant) { return face::Matrix{1, 3, {0.1 * variant, 0.2, 0.3}}; });

// Six groups of four neighbours each.
const Maker six_groups = made([](int variant) {
  face::Matrix labels{24, 1, {}};
  for (int i = 0; i < 24; ++i) labels.values.push_back((i / 4 + variant) % 6);
  return labels;
});

const Maker merge_curve = made([](int variant) {
  return face::Table{{"groups", "distance_merged", "error"},
                     {{"1", {1, 0.4, 0.9}}, {"2", {2, 0.2, 0.3 + 0.1 * variant}}, {"3", {3, 0, 0.1}}}};
});

const Registered cluster({
    .inputs =
        {
            {"cluster.affinity_propagation.points", heaps},
            {"cluster.k_means.points", heaps},
            {"cluster.k_medoids.points", heaps},
            {"cluster.key_shapes_direct.points", heaps},
            {"cluster.key_shapes_direct.neutral", rest},
            {"cluster.merge.points", heaps},
            {"cluster.merge.neutral", rest},
            {"cluster.merge.labels", six_groups},
            {"cluster.merge.exemplars", columns_of({{0, 4, 8, 12, 16, 20}, {1, 5, 9, 13, 17, 21}})},
            {"cluster.landmark_points.tracks", losing_points(another("landmarks", 0))},
            {"cluster.key_shapes.frames", columns_of({{0, 1, 2, 3}, {3, 2, 1, 0}})},
            {"cluster.key_shapes.labels", columns_of({{0, 0, 0, 1}, {0, 1, 0, 1}})},
            {"cluster.key_shapes.exemplars", columns_of({{1, 3}, {0, 3}})},
            {"cluster.key_shape_sheet.curve", merge_curve},
        },
    .params =
        {
            {"cluster.k_means.groups", whole(4)},
            {"cluster.k_medoids.groups", whole(4)},
            {"cluster.key_shapes_direct.groups", whole(3)},
            {"cluster.affinity_propagation.candidates", whole(8)},
            {"cluster.key_shape_sheet.picture_px", whole(48)},
        },
});

}  // namespace
}  // namespace conformance
