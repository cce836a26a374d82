// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"

namespace face::track {

struct FindContactOptions {
  double shut_share = 0.03;  // of the frames: so many at least show lips that meet
  double shut_ratio = 1.25;  // openings up to so many times theirs are shut,
  double open_ratio = 1.5;   // from so many times on open
};

// Whether the lips meet in the middle of the mouth, by the picture alone: 1 where they do, 0 where they do not, between
// them where it is doubtful. openings: of every frame (mouth_opening.h), below 0 = not seen, which gives 0. What lips
// that meet show depends on the speaker, the light and the camera: a small share of the frames, those that show least,
// tell it. In a clip whose lips never meet those count as shut which are nearest to it.
void find_contact(const engine::Seq<double>& openings, engine::SeqWriter<double>& contacts,
                  const FindContactOptions& options = {});

}  // namespace face::track
