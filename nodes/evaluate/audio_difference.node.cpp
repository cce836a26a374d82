// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/evaluate/number_differences.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.audio_difference", &audio_difference, version{1}, doc{"How two recordings differ, sample by sample."},
     input{"a", "A recording"}, input{"b", "Another"},
     output("table", "rms, largest, level_db of the difference against a, longer_s"));
