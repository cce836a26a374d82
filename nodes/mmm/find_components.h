// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mmm.h"
#include "nodes/types/weights.h"

namespace face::mmm {

struct FindComponentsOptions {
  std::int64_t count = 20;
};

// What a speaker's pictures do together: K uncorrelated numbers of variance 1 in place of the 2 N parameters, whose
// flows and pictures resemble each other, so that a number of one prototype says little by itself and its variance
// less. Trajectories (trajectory.train_phones, speak_gaussian) want both: their energy adds up over the numbers, and
// their smoothness is weighed against 1. Principal components of the parameters in grey levels: alpha moves pixels,
// which changes grey by the reference's mean gradient per pixel; beta mixes pictures. Not in the papers, whose
// Gaussians have full covariances of all 92.
//
// parameters: T x 2 N, of mmm.analyse; frames that are empty do not count. Result: (1 + 2 K) x 2 N: the mean; K rows
// that take parameters to numbers; K rows that take numbers to parameters (least squares). K is smaller than count
// where the parameters vary in fewer ways. Throws where all frames are empty.
Matrix find_components(const Mmm& model, const engine::Seq<Weights>& parameters,
                       const FindComponentsOptions& options = {});

// How many numbers these are. Throws where it is no such matrix; `name` is told.
std::size_t component_count(const Matrix& components);

}  // namespace face::mmm
