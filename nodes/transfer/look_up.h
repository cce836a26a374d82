// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/surface_map.h"

namespace face::transfer {

struct LookUpOptions {
  double reach_mm = 4;
  double lip_reach_mm = 25;
  double depth_mm = 12;
};

// Which point of an identity model every vertex of a speaking model is: "if vertices i and k point to the same
// coordinates h, phi, they correspond" (Bargmann, Blanz and Seidel, section 6), between vertices by linear
// interpolation in the triangle that covers the vertex's (h, phi). Of several layers the one nearest in radius counts;
// one farther than depth_mm behind or before does not. Beside all triangles, the nearest within reach_mm. Found are
// skin, eyeballs and brows; not lashes, nor what is in the mouth. Differs from the paper: within lip_reach_mm of the
// seam (along the skin) a vertex of the upper lip finds triangles of the upper lip alone and one of the lower lip those
// of the lower, so that lips that touch do not stick together. The sides come from the mesh's mouth opening and from
// the model's inner lips. fitted: the model's vertices in the neutral frame, from transfer.fit_identity; mesh, shape:
// the speaking model's mesh and its vertices in that frame; axis: of that frame. Result: V x 1 pixels, triangles of the
// fan triangulation of the model's mesh, -1 where there is none.
SurfaceMap look_up(const MorphableModel& model, const MeshPoints& fitted, const Mesh& mesh, const MeshPoints& shape,
                   const Axis& axis, const LookUpOptions& options = {});

}  // namespace face::transfer
