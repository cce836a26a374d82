// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "nodes/types/morphable_model.h"

namespace face::model {

struct NamedVertex {
  std::uint32_t vertex = 0;
  bool contour = false;  // no vertex of its own: somewhere on the outline of cheek or jaw
};

// The model's vertex that a point's name stands for:
//   eye_inner_r, mouth_corner_l, nose_tip, chin ...  (r is the face's own right, left in its picture)
//   lip_0 to lip_11    outer lip from the right corner over the upper lip; inner_lip_0 to inner_lip_7 likewise
//   0 to 67            Multi-PIE's numbers; 0 to 7 and 9 to 16 lie on the outline
//   jaw_r, jaw_l, cheek_r, cheek_l, contour_...   on the outline
//   vertex_N           vertex N of the mesh
// Throws on any other, and where the model has no such vertex.
NamedVertex name_landmark(const MorphableModel& model, const std::string& name);

}  // namespace face::model
