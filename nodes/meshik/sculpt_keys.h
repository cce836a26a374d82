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
  // With visemes: how far a speaker goes beyond the table; how much of the variance is what all visemes have in common,
  // the rest is one viseme's (1 = as if there were one alone); how far every weight may go by itself. The error of a
  // coordinate of a landmark, and of how far inner lips are apart.
  double variety = 2;
  double common_share = 0.1;
  double own_deviation = 0.02;
  double landmark_error_mm = 0.4;
  double gap_error_mm = 0.2;
};

struct SculptKeysResult {
  Mesh reference;        // the rig at rest
  double mm_per_px = 0;  // how large a pixel is on the rig
  double rms_mm = 0;     // of the landmarks' places that no weights reach
};

// A mesh for every key shape without an artist: the rig's jaw and mouth weights in [0, 1] whose landmarks have moved,
// seen from the front, as the speaker's have from the neutral (least squares, coordinate by coordinate; Hildreth, A
// Quadratic Programming Procedure, 1957). The outer edge of the lips alone does not tell a dropped jaw from a funnel:
// visemes (null = none) say which weights go together in speech. Each is a Gaussian about the rest, wide along its own
// weights, by common_share of what all have in common (their second moments about 0) and by own_deviation; the weights
// are the mean over visemes, each as likely as it explains the landmarks (a mixture; one Gaussian for all takes an F,
// two of forty phones, for pressed lips). Visemes whose lips meet count with mouthClose as large as jawOpen, those
// whose lower lip meets the teeth with mouthRollLower 1. How far inner lips are apart, where landmarks say it, counts
// beside their places: what is wrong with the head's pose or with how thick lips are is not in it. The scale of the
// pictures is that at which the neutral landmarks fit the rig's best. Meshes of an artist take the place of
// `key_meshes`. neutral: the speaker's landmarks at rest, in the order of the key shapes'.
SculptKeysResult sculpt_keys(const Rig& rig, const KeyShapes& key_shapes, const Landmarks& neutral,
                             const Visemes* visemes, engine::SeqWriter<Mesh>& key_meshes,
                             engine::SeqWriter<Weights>& rig_weights, const SculptKeysOptions& options = {});

}  // namespace face::meshik
