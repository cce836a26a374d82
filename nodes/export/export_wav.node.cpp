// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_wav.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.wav", &export_wav, version{1}, doc{"Writes a recording as WAV, 16 bits."}, input{"audio", "A recording"},
     output("file", "The .wav file"));
