// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"

namespace face::transfer {

struct ProjectCylinderOptions {
  std::int64_t columns = 720;
  double step_mm = 0.8;
};

struct ProjectCylinderResult {
  CylinderScan scan;
  Landmarks marks;  // of the scan's picture: nose_tip and, of an open mouth, inner_lip_0, inner_lip_4 (its corners)
};

// A frame of viseme space around an axis: radius and grey over height and angle (Bargmann, Blanz and Seidel, section
// 6), to which a model of identities is fitted. mesh: of model.scan_mesh, whose polygons, colours and mouth opening
// count; shape: where its vertices are in that frame. Where surfaces lie behind one another the outermost counts. Rows
// go from the highest vertex to the lowest, columns over the full turn.
// The tip of the nose is the vertex farthest from the axis among those above the mouth's opening, no more than 30 mm to
// its sides and 70 mm up; without an opening the farthest of all.
ProjectCylinderResult project_cylinder(const Mesh& mesh, const MeshPoints& shape, const Axis& axis,
                                       const ProjectCylinderOptions& options = {});

}  // namespace face::transfer
