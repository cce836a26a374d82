// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/timeline.h"

namespace face::track {

struct ReportResult {
  std::string text;   // a line each
  engine::File file;  // the same, .txt
};

// Says in which frames something is wrong with a track: frames without contrast, cuts, lost faces, lost points by name,
// and frames that are shown longer or shorter than most (by more than a tenth: a film of variable rate; its times hold
// all the same), and where so many points are lost that they hardly lie on a face. Neighbouring frames share a line. What
// concerns whole frames or the whole track is a warning, too. landmarks, state: of
// track_klt, element by element. timeline: of the frames; null = not judged.
ReportResult report(const engine::Seq<Landmarks>& landmarks, const engine::Seq<std::string>& state,
                    const Timeline* timeline, engine::Progress& progress);

}  // namespace face::track
