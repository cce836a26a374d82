// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include "nodes/types/face_fit.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

// Vertices at these coefficients, V x 3 mm. Lists may be shorter than the space, never longer.
std::vector<Vec3f> pose_model(const MorphableModel& model, const std::vector<float>& identity,
                              const std::vector<float>& expression);

// Linear reflectance of every vertex at these coefficients, V x 3.
std::vector<Vec3f> albedo_of(const MorphableModel& model, const std::vector<float>& albedo);

// How much expression coefficient k moves inner lip pair p apart, mm: rows[p][k]. The pair's gap is the sum with the
// coefficients, the lip gap the mean over pairs.
std::vector<std::vector<double>> lip_gap_rows(const MorphableModel& model);
double lip_gap_of(const MorphableModel& model, const std::vector<float>& expression);

// The point of the mean head about which poses turn: the middle of its landmarks, or of its skin.
Vec3f turning_point(const MorphableModel& model);

}  // namespace face::model
