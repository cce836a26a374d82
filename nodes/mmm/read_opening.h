// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/table.h"

namespace face::mmm {

struct ReadOpeningOptions {
  std::string upper = "62";  // points of the true landmarks whose distance down the picture is how far a mouth is open
  std::string lower = "66";
  std::int64_t width_px = 64;   // of the small grey pictures that are read; the height goes with it
  std::int64_t pictures = 600;  // at most, of those that are known, evenly
  double restraint = 1e4;       // of the ridge regression, grey values squared
};

struct ReadOpeningResult {
  // Row "all": reader_r (of known pictures that it was not learned from), r, amplitude (slope of what is read over the
  // truth), error_px (RMS). NaN where either does not vary.
  Table table;
  Table frames;  // read_px and true_px of each frame
};

// How far a mouth is open in pictures, and whether it is when it should be: read by ridge regression on small grey
// pictures (Hoerl and Kennard, Ridge Regression, Technometrics 1970), learned from pictures whose points are known.
// Reading does not care which model made a picture. known, known_truth: as many, at least four; images, truth: as many.
ReadOpeningResult read_opening(const engine::Seq<Image>& known, const engine::Seq<Landmarks>& known_truth,
                               const engine::Seq<Image>& images, const engine::Seq<Landmarks>& truth,
                               const ReadOpeningOptions& options = {});

}  // namespace face::mmm
