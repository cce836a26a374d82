// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/example_meshes.h"

#include <algorithm>

#include "nodes/base/check.h"

namespace face::mmm {

Mesh example_meshes(const Rig& rig, engine::SeqWriter<Mesh>& examples, const ExampleMeshesOptions& options) {
  for (const std::string& name : options.shapes) {
    const auto shape =
        std::find_if(rig.shapes.begin(), rig.shapes.end(), [&](const Shape& s) { return s.name == name; });
    check(shape != rig.shapes.end() && !shape->vertices.empty(), "the rig has no shape \"", name,
          "\" that moves a vertex");
    Mesh mesh = rig.neutral;
    for (std::size_t i = 0; i < shape->vertices.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        mesh.points_mm[shape->vertices[i]][axis] += shape->offsets_mm[i][axis];
    examples.push(name, std::move(mesh));
  }
  return rig.neutral;
}

}  // namespace face::mmm
