// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/model/lip_rims.h"
#include "nodes/model/pixel_rows.h"
#include "nodes/model/skin_basis.h"
#include "nodes/types/albedo_map.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

// What stays of a person from frame to frame.
struct TrackedPerson {
  SkinBasis skin;                         // its mean is this person's head at rest
  SkinBasis lidless;                      // without the triangles about the eyes
  std::vector<Vec3f> colours;             // of the skin's vertices
  PictureState first;                     // of the picture that the person was fitted on
  std::vector<std::vector<double>> gaps;  // lip_gap_rows, of as many expressions
  PartingLips lips;
};

// start: the fit of that picture. albedo: the person's colours. expressions: how many components move.
TrackedPerson tracked_person(const MorphableModel& model, const FaceFit& start, const AlbedoMap& albedo,
                             std::size_t expressions);

// The leading coefficients of a fit's expression.
std::vector<double> expression_of(const FaceFit& fit, std::size_t expressions);

// No coefficients of identity: the basis is the person's.
inline const std::vector<double> as_is;

}  // namespace face::model
