// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::meshik {

struct SculptKeysOptions {
  double restraint = 0.02;  // pulls every weight to 0, as a share of what an average shape moves
};

struct SculptKeysResult {
  Mesh reference;        // the rig at rest
  double mm_per_px = 0;  // how large a pixel is on the rig
  double rms_mm = 0;     // of the landmarks' places that no weights reach
};

// A mesh for every key shape without an artist: the rig's jaw and mouth weights in [0, 1] whose landmarks have moved,
// seen from the front, as the speaker's have from the neutral (least squares, coordinate by coordinate; Hildreth, A
// Quadratic Programming Procedure, 1957). The scale of the pictures is that at which the neutral landmarks fit the
// rig's best. Meshes of an artist take the place of `key_meshes`. neutral: the speaker's landmarks at rest, in the
// order of the key shapes'.
SculptKeysResult sculpt_keys(const Rig& rig, const KeyShapes& key_shapes, const Landmarks& neutral,
                             engine::SeqWriter<Mesh>& key_meshes, engine::SeqWriter<Weights>& rig_weights,
                             const SculptKeysOptions& options = {});

}  // namespace face::meshik
