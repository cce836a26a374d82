// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/weights.h"

namespace face::weights {

enum class FitMethod { nonnegative, least_squares };

struct FitKeyShapesOptions {
  FitMethod method = FitMethod::nonnegative;
  bool sum_to_one = false;
  int max_lost = 0;  // so many landmarks of a frame may be lost: they count where the tracker has left them
};

// Weights of the key shapes for every frame of a performance (Animating Lip-Sync Speech Faces, Eq 5; Eq 4 for
// least_squares). neutral: the landmarks at rest, subtracted from everything; null: absolute positions, as the paper
// has it. A frame that lost more than max_lost landmarks gets no weights (an empty list). All landmarks by name in the
// order of the key shapes.
void fit_key_shapes(const engine::Seq<Landmarks>& tracks, const KeyShapes& key_shapes, const Landmarks* neutral,
                    engine::SeqWriter<Weights>& weights, const FitKeyShapesOptions& options = {});

}  // namespace face::weights
