// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"

namespace face::track {

struct FindContactOptions {
  double shut_share = 0.03;  // of the frames: so many at least show lips that meet
  double seam = 0.0048;      // usual widths of a mouth: what the seam of the best picture shows, added to all openings
  double most_shut = 0.02;   // and what lips that meet show at most, so that a mouth that never shuts stays open
  double shut_ratio = 1.84;  // openings up to so many times theirs are shut,
  double open_ratio = 2.76;  // from so many times on open
  double tucked = 0.78;      // share of the lower lip in both, as a share of usual, up to which it is behind the teeth,
  double untucked = 0.86;    // and from which on it is not
};

// Whether the lips meet in the middle of the mouth, by the picture alone: 1 where they do, 0 where they do not, between
// them where it is doubtful. openings: of every frame (mouth_opening.h), below 0 = not seen, which gives 0. What lips
// that meet show depends on the speaker, the light and the camera: a small share of the frames, those that show least,
// tell it, up to what no lips that meet show.
// An F or V shows as little between the lips, but the lower one is behind the upper teeth: what is seen of it is
// thinner next to the upper lip than in other shut mouths. landmarks: of every frame, with where the lips part
// (inner_lips.h); null = nothing is said of F and V.
void find_contact(const engine::Seq<double>& openings, const engine::Seq<Landmarks>* landmarks,
                  engine::SeqWriter<double>& contacts, const FindContactOptions& options = {});

}  // namespace face::track
