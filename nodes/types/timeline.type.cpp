// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/timeline.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Timeline, "timeline", codec_version{1}, doc{"When each element of a timed sequence is shown."},
     field<&Timeline::time_s>(), field<&Timeline::duration_s>());
