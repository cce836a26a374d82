// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/shape_model.h"

namespace face::transfer {

// The speaking model on another face: its mean departs from the new neutral (to) as it did from the old one (from), and
// its modes are the same displacements, vertex by vertex (Bargmann, Blanz and Seidel, section 6: "the deformations are
// transferred within the morphable model", copied unchanged). Coefficients mean what they meant. from, to: V points in
// one world, the model's V vertices.
ShapeModel move_model(const ShapeModel& model, const MeshPoints& from, const MeshPoints& to);

// The same space with coefficients that count from the neutral face: its mean is rest as the space can show it (its
// projection), so that coefficients 0 are the neutral face. rest: V points.
ShapeModel rest_model(const ShapeModel& model, const MeshPoints& rest);

struct FreezeEdgesOptions {
  double width_mm = 12;
};

// Holds the edge of a face still, where scans swim (edge vertices "may be frozen", section 7): within width_mm of the
// mesh's outline, along its surface, modes fade to nothing (smoothly, at the outline itself they are 0). The opening of
// the mouth is no outline. Coefficients of a shape are found as before. mesh: whose vertices the model has.
ShapeModel freeze_edges(const ShapeModel& model, const Mesh& mesh, const FreezeEdgesOptions& options = {});

}  // namespace face::transfer
