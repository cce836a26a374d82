// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mesh_lip_gap.h"

#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/types/weights.h"

namespace face::evaluate {
namespace {

// The frames' lips as shapes of a rig, and each frame as the weight 1 of its own.
engine::Seq<Weights> as_shapes(const engine::Seq<MeshPoints>& frames, const char* name, Rig& lips) {
  std::vector<Weights> weights;
  std::vector<std::string> ids;
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const auto frame = frames.at(t);
    ids.push_back(frames.id(t));
    Shape shape{ids.back(), {}, {}};
    for (const LipPair& pair : lips.inner_lips)
      for (const std::uint32_t v : {pair.upper, pair.lower}) {
        check(v < frame->points_mm.size(), name, " ", ids.back(), " has ", frame->points_mm.size(),
              " vertices, the rig's lips vertex ", v);
        Vec3f offset{};
        for (std::size_t k = 0; k < 3; ++k) offset[k] = frame->points_mm[v][k] - lips.neutral.points_mm[v][k];
        shape.vertices.push_back(v);
        shape.offsets_mm.push_back(offset);
      }
    weights.emplace_back();
    weights.back().values.assign(lips.shapes.size(), 0.0f);
    weights.back().values.push_back(1);
    lips.shapes.push_back(std::move(shape));
  }
  return {std::move(weights), std::move(ids)};
}

}  // namespace

LipGapResult mesh_lip_gap(const Rig& rig, const engine::Seq<MeshPoints>& points, const engine::Seq<MeshPoints>* truth,
                          const MeshPoints& closed, const Phones& phones, const Timeline& timeline,
                          const LipGapOptions& options) {
  check(closed.points_mm.size() == rig.neutral.points_mm.size(), "closed has ", closed.points_mm.size(),
        " vertices, the rig ", rig.neutral.points_mm.size());
  Rig lips;
  lips.neutral.points_mm = closed.points_mm;
  // A vertex that is in two pairs is moved once.
  std::vector<std::uint8_t> seen(closed.points_mm.size(), 0);
  for (const LipPair& pair : rig.inner_lips) {
    check(pair.upper < seen.size() && pair.lower < seen.size(), "a lip pair has the vertices ", pair.upper, " and ",
          pair.lower, ", the rig ", seen.size());
    if (seen[pair.upper] || seen[pair.lower]) continue;
    seen[pair.upper] = seen[pair.lower] = 1;
    lips.inner_lips.push_back(pair);
  }
  const engine::Seq<Weights> own = as_shapes(points, "points", lips);
  if (!truth) return lip_gap(lips, own, nullptr, phones, timeline, options);
  const engine::Seq<Weights> right = as_shapes(*truth, "truth", lips);
  return lip_gap(lips, own, &right, phones, timeline, options);
}

}  // namespace face::evaluate
