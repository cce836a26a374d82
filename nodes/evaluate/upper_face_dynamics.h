// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/rig.h"
#include "nodes/types/table.h"
#include "nodes/types/vertex_mask.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

// Upper-face dynamics deviation (FDD; Xing et al., CodeTalker, CVPR 2023, section 4.2 and its cal_metric): the mean
// over the upper face's vertices of std_t |y_ti - n_i|^2 - std_t |x_ti - n_i|^2, with y the truth, x what is judged and
// n the neutral. Positive: x moves less than the truth. std divides by the count. Returns one row: fdd_mm2, truth_mm2
// and own_mm2 (the means of both terms). upper_face: V; null = upper_face_vertices(rig).
Table upper_face_dynamics(const Rig& rig, const engine::Seq<Weights>& weights, const engine::Seq<Weights>& truth,
                          const VertexMask* upper_face);

}  // namespace face::evaluate
