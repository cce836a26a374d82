// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"
#include "nodes/types/visemes.h"
#include "nodes/types/weights.h"

namespace face::meshik {

struct SculptKeysOptions {
  double restraint = 0.02;  // without visemes: pulls every weight to 0, as a share of what an average shape moves
  // With visemes: how far a speaker goes beyond the table, how far every weight may go by itself, and the error of a
  // coordinate of a landmark.
  double variety = 2;
  double own_deviation = 0.02;
  double landmark_error_mm = 0.4;
};

struct SculptKeysResult {
  Mesh reference;        // the rig at rest
  double mm_per_px = 0;  // how large a pixel is on the rig
  double rms_mm = 0;     // of the landmarks' places that no weights reach
};

// A mesh for every key shape without an artist: the rig's jaw and mouth weights in [0, 1] whose landmarks have moved,
// seen from the front, as the speaker's have from the neutral (least squares, coordinate by coordinate; Hildreth, A
// Quadratic Programming Procedure, 1957). The outer edge of the lips alone does not tell a dropped jaw from a funnel:
// visemes (null = none) say which weights go together in speech. The weights that they have in common, their second
// moments about 0, are the covariance of a Gaussian about the rest, of which and the landmarks the most likely weights
// are taken. Visemes whose lips meet count with mouthClose as large as jawOpen. The scale of the pictures is that at
// which the neutral landmarks fit the rig's best. Meshes of an artist take the place of `key_meshes`. neutral: the
// speaker's landmarks at rest, in the order of the key shapes'.
SculptKeysResult sculpt_keys(const Rig& rig, const KeyShapes& key_shapes, const Landmarks& neutral,
                             const Visemes* visemes, engine::SeqWriter<Mesh>& key_meshes,
                             engine::SeqWriter<Weights>& rig_weights, const SculptKeysOptions& options = {});

}  // namespace face::meshik
