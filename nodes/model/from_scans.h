// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/table.h"

namespace face::model {

struct FromScansOptions {
  std::int64_t expression_components = 10;
  std::int64_t identity_components = 99;
  std::int64_t albedo_components = 99;
  double lamp_shading = 0;  // how much the scanner's colours darken with the angle to its lamp; 0: they are albedo
};

// A morphable model from scans (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and Video, 2003, sections 2.5
// and 2.6), which model.fit_image takes. Two analyses are kept apart: expressions of one person, identities and colours
// of many. Expressions are analysed about the neutral face, not about their mean as in the paper, so that coefficients
// 0 are the neutral. Coefficient 1 is one standard deviation. Teeth and inner mouth of the surface go along: lower
// teeth with the chin's expression, walls with the lips'; of identities, all of them with the middle of the corners of
// the mouth and the lips' middle (section 2.4: the same teeth for all persons, at a fixed place relative to these).
// Colours are sRGB; with lamp_shading they are divided by 1 - lamp_shading + lamp_shading * cos(normal, radius), as
// the lamp on the scanner's arm has shaded them. surface: with or without teeth; expressions, neutral, identities: its
// skin, at rest. textures: one per identity.
MorphableModel from_scans(const MorphableModel& surface, const engine::Seq<MeshPoints>& expressions,
                          const MeshPoints& neutral, const engine::Seq<MeshPoints>& identities,
                          const engine::Seq<Image>& textures, const FromScansOptions& options = {});

// Angles and ratio of section 2.6 on the shapes themselves, before components are dropped: expressions against the span
// of the identities, and as the control every other identity against the rest. Rows and columns as of compare_spaces.
Table compare_shapes(const MorphableModel& surface, const engine::Seq<MeshPoints>& expressions,
                     const engine::Seq<MeshPoints>& identities);

}  // namespace face::model
