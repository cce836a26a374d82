// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/example_meshes.h"

#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/types/arkit.h"

namespace face::mmm {

Mesh example_meshes(const Rig& rig, engine::SeqWriter<Mesh>& examples, const ExampleMeshesOptions& options) {
  bool any = false;
  for (const std::string& name : options.shapes) {
    const auto shape =
        std::find_if(rig.shapes.begin(), rig.shapes.end(), [&](const Shape& s) { return s.name == name; });
    check(shape != rig.shapes.end() || arkit_index(name) < arkit_count, "the rig has no shape \"", name, "\"");
    if (shape == rig.shapes.end() || shape->vertices.empty()) continue;
    Mesh mesh = rig.neutral;
    add_shape(*shape, 1, mesh.points_mm);
    examples.push(name, std::move(mesh));
    any = true;
  }
  check(any, "no shape of the ", options.shapes.size(), " that are asked for moves a vertex of the rig");
  return rig.neutral;
}

}  // namespace face::mmm
