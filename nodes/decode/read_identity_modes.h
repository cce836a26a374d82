// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/types/shape_set.h"

namespace face::decode {

struct ReadIdentityModesOptions {
  LengthUnit unit = LengthUnit::automatic;  // of the lengths in the files, as in read_rig
};

// Reads the identity modes of an ICT-FaceKit folder: identityNNN.obj, each a head at one standard deviation of the mode
// (Li et al., Learning Formation of Physically-Based Face Attributes, CVPR 2020: a PCA of neutral heads), as offsets
// from the neutral mesh, for the vertices of read_rig on the same folder. Shapes are named as the files, in the order
// of their numbers. Files may hold `v` lines only. Throws where the folder has no neutral, no identity, or one of
// another vertex count.
ShapeSet read_identity_modes(const engine::File& folder, const ReadIdentityModesOptions& options = {});

}  // namespace face::decode
