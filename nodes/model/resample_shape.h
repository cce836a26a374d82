// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

struct ResampleShapeResult {
  MeshPoints shape;  // vertices of the other topology
  Image texture;     // RGB, one row
};

// A person's shape in another topology (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and Video, 2003,
// section 2.5: the identity space resampled into the topology of the expressions). anchors: where the other topology's
// vertices lie on the surface in the shape `mean` (match_cylinder of the other's closed mouth to it). A vertex takes
// the displacement from mean to shape, and the colour, of the triangle of the surface that the scanner sees at its
// place, or of the nearest vertex beyond the surface's border; what lies under the surface there (inner lips) keeps its
// offset. shape, mean: skin vertices of surface. texture: of shape, one row.
ResampleShapeResult resample_shape(const MeshPoints& shape, const Image& texture, const MorphableModel& surface,
                                   const MeshPoints& mean, const MeshPoints& anchors);

// What one shape is beyond another, added to a third: the scan of A smiling minus A neutral plus B neutral (Fig. 1).
// All three in one topology and at rest.
MeshPoints add_expression(const MeshPoints& expression, const MeshPoints& neutral, const MeshPoints& other);

}  // namespace face::model
