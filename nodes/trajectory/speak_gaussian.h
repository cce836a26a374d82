// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "engine/port.h"
#include "nodes/trajectory/speech_targets.h"
#include "nodes/types/phone_statistics.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::trajectory {

enum class CovarianceUse { diagonal, full };

// Where the middle of a bilabial closure is held.
enum class Closures {
  free,     // nowhere: as published
  trained,  // at the mean of its phone
  rest,     // at 0, where parameters count from the shut mouth
};

struct SpeakGaussianOptions {
  double rate_hz = 30;
  double smoothness = 10;  // lambda at 30 frames per second, the paper's
  CovarianceUse covariance = CovarianceUse::diagonal;
  Normalise normalise = Normalise::none;
  Closures closures = Closures::free;
  // With closures at rest: time that lips take to shut before a closure and to part after it, in which the phones there
  // are pulled towards the rest as well; 0 = the closure's middle alone is.
  double closing_s = 0;
};

// The statistic of a label: its own, else that of the whole phone or of its closure or release, else that of a
// consonant that looks the same on the lips (P B M, F V, TH DH, T D N, K G NG, S Z, SH ZH CH JH; Fisher, Confusions
// among Visually Perceived Consonants, JSHR 1968), else that of all speech.
const PhoneStatistic& find_statistic(const PhoneStatistics& statistics, const std::string& label);

// Turns phones into the path of least energy through a trained speaker's Gaussians (Animating Lip-Sync Speech Faces,
// Eqs 6 and 7; Ezzat, Geiger and Poggio 2002): (x - mu)' D' Sigma^-1 D (x - mu) + lambda |x_t - x_(t-1)|^2. The plain
// variant of trajectory.speak, for comparison.
// Differs from the paper: lambda is per time, not per frame: lambda (rate / 30 Hz)^2; optionally the whole covariance;
// optionally the middle of every bilabial closure is held where training had it, or at rest (the paper's large
// variances of plosives leave lips open, and at 25 or 30 frames per second so does the mean of a closure of three
// frames).
Timeline speak_gaussian(const Phones& phones, const PhoneStatistics& statistics, engine::SeqWriter<Weights>& weights,
                        const SpeakGaussianOptions& options = {});

}  // namespace face::trajectory
