// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/model/landmark_basis.h"
#include "nodes/model/pixel_rows.h"

namespace face::model {

// The vertices of a model that may come to lie on the outline of cheek and jaw, as a LandmarkBasis without points.
LandmarkBasis outline_basis(const MorphableModel& model, std::size_t identities, std::size_t expressions);

// Where the outline of cheek and jaw lies in a picture (silhouette edges after Moghaddam, Lee, Pfister, Machiraju,
// Model-Based 3D Face Capture with Shape-from-Silhouettes, AMFG 2003, with edges of one picture in place of a
// silhouette): every rim vertex, its normal all but orthogonal to the line of sight, looks along its normal in the
// picture for the strongest change of colour, near before far; the distance along the normal is its residual. Those
// that see no clear edge have no row. Columns: pose, identity, expression; residuals in the picture's pixels, to be
// counted less the farther they are.
LandmarkRows outline_rows(const LandmarkBasis& outline, const std::vector<Vec3f>& posed_mm, const FacePose& pose,
                          const PictureLevel& level);

}  // namespace face::model
