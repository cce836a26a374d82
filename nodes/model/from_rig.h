// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"
#include "nodes/types/shape_set.h"

namespace face::model {

struct FromRigOptions {
  std::int64_t expressions = 10;  // components kept, as in the paper
  std::int64_t albedos = 99;      // components kept at most
  std::int64_t samples = 400;     // faces drawn from the rig for its expression space
  std::int64_t skins = 120;       // made persons' skins for its albedo space; 0 = waves alone
  std::int64_t seed = 1;
};

// A morphable model from a rig and its identity modes (null: one person).
// Identity: the modes as they are, coefficient 1 is one standard deviation. Expression: principal components of
// `samples` faces drawn from the rig's blend shapes, mostly with a speaking mouth, about the neutral face and not about
// their mean, so that coefficients 0 are the neutral. Coefficient 1 is one standard deviation as well. Albedo: the rig
// brings one person's colours only, so skins are made (phantom.make_person) and analysed; slow waves over the face
// (cosines) in lightness, redness and yellowness fill up the rest. Without skins, or landmarks to place them: waves and
// made features.
// (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and Video, Eurographics 2003, section 2, has all three
// from 35 scans of one person and neutral scans of 200.)
MorphableModel from_rig(const Rig& rig, const ShapeSet* identities, const FromRigOptions& options = {});

// The albedo of such a model: its mean and components, of the rig's polygons, colours and landmarks alone.
void add_made_skins(const Rig& rig, const FromRigOptions& options, MorphableModel& model);

}  // namespace face::model
