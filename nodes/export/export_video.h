// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/audio.h"
#include "nodes/types/image.h"
#include "nodes/types/timeline.h"

namespace face::exports {

struct ExportVideoOptions {
  int quality = 18;  // x264's constant rate factor: 0 is lossless, 18 looks so, 51 is worst
  int audio_kbit_per_s = 96;
};

// Writes pictures and, if given, their sound as MP4: H.264 (4:2:0, BT.709; libx264 with one thread) and AAC. Every
// picture is shown from its time in the timeline until the next one's. The sound is cut, or filled up with silence, to
// the timeline's duration, and a difference of more than a frame is a warning. Pictures of odd size get one more column
// or row, which repeats the last. The same input gives the same bytes: there is no date, and no other run-dependent
// thing, in the file.
engine::File export_video(const engine::Seq<Image>& frames, const Timeline& timeline, const Audio* audio,
                          const ExportVideoOptions& options, engine::Progress& progress);

}  // namespace face::exports
