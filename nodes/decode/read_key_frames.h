// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/timeline.h"

namespace face::decode {

// Reads the frames of a video file that key shapes are of, a few of many, as read_video.h reads them and by the same
// ids, in the film's order. timeline: of all its frames, as read_video gives it. Where a container keeps the time of
// every frame (MP4, MOV, MKV, WebM) each is decoded from the last key frame on that the file names, if what comes has
// the timeline's times; any other film is decoded from its beginning. Throws where a key shape is of no frame of the
// timeline, and as read_video does.
void read_key_frames(const engine::File& file, const Timeline& timeline, const KeyShapes& key_shapes,
                     engine::SeqWriter<Image>& frames, engine::Progress& progress);

}  // namespace face::decode
