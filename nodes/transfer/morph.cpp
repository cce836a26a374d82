// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/morph.h"

#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"

namespace face::transfer {

void morph(const Rig& from, const Rig& to, const engine::Seq<Weights>& weights, engine::SeqWriter<Rig>& heads,
           engine::SeqWriter<Weights>& poses, const MorphOptions& options) {
  check(from.neutral.points_mm.size() == to.neutral.points_mm.size(), "from has ", from.neutral.points_mm.size(),
        " points, to ", to.neutral.points_mm.size());
  check(from.neutral.colors_srgb.size() == to.neutral.colors_srgb.size(), "from has ", from.neutral.colors_srgb.size(),
        " colours, to ", to.neutral.colors_srgb.size());
  check(options.end >= options.begin, "begin is ", options.begin, ", end ", options.end, ", expected it not before");
  const double last = std::max(1.0, static_cast<double>(weights.size()) - 1);
  for (std::size_t t = 0; t < weights.size(); ++t) {
    const auto pose = weights.at(t);
    const double at = static_cast<double>(t) / last;
    const double s = options.end > options.begin
                         ? std::clamp((at - options.begin) / (options.end - options.begin), 0.0, 1.0)
                         : (at < options.begin ? 0 : 1);
    const auto share = static_cast<float>(s * s * (3 - 2 * s));
    const auto mix = [share](std::vector<Vec3f> a, const std::vector<Vec3f>& b) {
      for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) a[i][k] = (1 - share) * a[i][k] + share * b[i][k];
      return a;
    };
    Rig head;
    head.neutral = from.neutral;
    head.neutral.colors_srgb = mix(from.neutral.colors_srgb, to.neutral.colors_srgb);
    Shape shape{"frame", {}, mix(pose_points(from, *pose), pose_points(to, *pose))};
    for (std::size_t v = 0; v < shape.offsets_mm.size(); ++v) {
      shape.vertices.push_back(static_cast<std::uint32_t>(v));
      for (std::size_t k = 0; k < 3; ++k) shape.offsets_mm[v][k] -= from.neutral.points_mm[v][k];
    }
    head.shapes = {std::move(shape)};
    head.inner_lips = from.inner_lips;
    heads.push(weights.id(t), std::move(head));
    poses.push(weights.id(t), Weights{{1.0f}});
  }
}

}  // namespace face::transfer
