// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/phone_statistics.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::trajectory {

enum class Blur { coordinates, none };

struct SpeakKernelOptions {
  Blur blur = Blur::coordinates;
  bool split_stops = true;
};

// Speech by the visemes of a viseme space, as Bargmann, Blanz and Seidel make it (section 5): every slot of 10 ms has
// the mean coordinates a_i of its phone, then
//   a'_i = 0.1 a_(i-1) + 0.5 a_i + 0.3 a_(i+1) + 0.1 a_(i+3)
// (slots before the first and after the last are as these), and four slots make one frame of 25 per second: their mean
// (Blur::coordinates; the cheap motion blur), or all 100 frames per second (Blur::none; average their pictures for the
// true one). Kept as published, to compare with: hardly any coarticulation, and closures that averaging leaves open.
// split_stops: closure and release of a stop have visemes of their own where the statistics have them; without it the
// mean of both, as in the paper.
Timeline speak_kernel(const Phones& phones, const PhoneStatistics& statistics, engine::SeqWriter<Weights>& weights,
                      const SpeakKernelOptions& options = {});

}  // namespace face::trajectory
