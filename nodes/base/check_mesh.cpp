// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/check_mesh.h"

#include "nodes/base/check.h"

namespace face {

void check_mesh(const Mesh& mesh) {
  check(mesh.colors_srgb.empty() || mesh.colors_srgb.size() == mesh.points_mm.size(), "the mesh has ",
        mesh.colors_srgb.size(), " vertex colours, but ", mesh.points_mm.size(), " vertices");
  check(mesh.corner_uvs.empty() || mesh.corner_uvs.size() == mesh.corners.size(), "the mesh has ",
        mesh.corner_uvs.size(), " texture coordinates at ", mesh.corners.size(), " corners");
  for (const std::uint32_t v : mesh.corners)
    check(v < mesh.points_mm.size(), "a polygon has vertex ", v, ", but the mesh has ", mesh.points_mm.size());
  for (const std::uint32_t v : mesh.corner_uvs)
    check(v < mesh.uvs.size(), "a corner has texture coordinate ", v, ", but the mesh has ", mesh.uvs.size());
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p)
    check(mesh.polygon_starts[p] <= mesh.polygon_starts[p + 1] && mesh.polygon_starts[p + 1] <= mesh.corners.size(),
          "polygon ", p, " ends at corner ", mesh.polygon_starts[p + 1], " of ", mesh.corners.size());
  for (const Part& part : mesh.parts)
    check(std::size_t{part.first_polygon} + part.polygon_count <= mesh.polygon_count(), "part \"", part.name,
          "\" ends at polygon ", std::size_t{part.first_polygon} + part.polygon_count, " of ", mesh.polygon_count());
}

}  // namespace face
